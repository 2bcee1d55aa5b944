import type { Vehicle, VehicleType } from "@/shared/api/types";

export type Camera = Vehicle["cameras"][number];

/** The cameras that the vehicle's type has, each with what the vehicle reported of it, if anything; none vanishes. */
export function shownCameras(
  vehicle: Pick<Vehicle, "cameras">,
  type: Pick<VehicleType, "cameras"> | undefined,
): { name: string; camera: Camera | undefined }[] {
  const names = new Set([...(type?.cameras ?? []), ...vehicle.cameras].map((c) => c.name));
  return [...names].map((name) => ({ name, camera: vehicle.cameras.find((c) => c.name === name) }));
}
