import type { VehicleType } from "@/shared/api/types";
import type { Camera } from "./shownCameras";

type CameraType = VehicleType["cameras"][number];

export interface OnPicture {
  u: number;
  v: number;
}

/** Where a place on the floor, so far from below the camera in the body frame, is in its full picture, px. */
export function onPicture(type: CameraType, forward_m: number, left_m: number): OnPicture {
  const mount = type.body_from_camera.heading_rad;
  // Image u is the camera's x, image v against its y, seen from above.
  const x = (Math.cos(mount) * forward_m + Math.sin(mount) * left_m) / type.height_m;
  const y = (-Math.sin(mount) * forward_m + Math.cos(mount) * left_m) / type.height_m;
  const bent = 1 + type.k1 * (x * x + y * y);
  return { u: type.cu_px + type.f_px * x * bent, v: type.cv_px - type.f_px * y * bent };
}

/** The corners of the code that a camera has read, in order. */
export function outlineOf(type: CameraType, camera: Camera, size_m: number): OnPicture[] {
  const [c, s] = [Math.cos(camera.angle_rad), Math.sin(camera.angle_rad)];
  const half = size_m / 2;
  return [
    [half, half],
    [-half, half],
    [-half, -half],
    [half, -half],
  ].map(([x = 0, y = 0]) =>
    onPicture(type, (camera.forward_m ?? 0) + c * x - s * y, (camera.left_m ?? 0) + s * x + c * y),
  );
}
