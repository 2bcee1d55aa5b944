import { boxOf } from "@/shared/math/geometry";
import type { DrawnVehicle } from "./scene";

const kLeastPx = 2;

/** In pixels of the screen, in the frame of the body (x ahead, y down: to the right). */
export interface Band {
  x: number;
  y: number;
  width: number;
  height: number;
  radius: number;
}

/** Three sigma of where a vehicle holds itself to be, around its whole body, since no point of it is better known; undefined
 * while nobody knows where it is, and where it is too narrow to be seen at `k` pixels a metre. */
export function deviationBand(
  { vehicle, type }: Pick<DrawnVehicle, "vehicle" | "type">,
  k: number,
): Band | undefined {
  const radius = (vehicle.pose_deviation_m ?? 0) * k;
  if (!vehicle.pose_known || radius < kLeastPx) return undefined;
  const box = boxOf(type.footprint);
  return {
    x: box.minX * k - radius,
    y: -box.maxY * k - radius,
    width: (box.maxX - box.minX) * k + 2 * radius,
    height: (box.maxY - box.minY) * k + 2 * radius,
    radius,
  };
}
