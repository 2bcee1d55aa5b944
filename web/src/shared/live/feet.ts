import type { Vehicle } from "@/shared/api/types";

/** Extension from which a foot stands on the floor (the server's limit for starting a move). */
export const kFootDown_m = 0.002;

export function feetDown(feet: Vehicle["parking_feet"]): boolean {
  return feet.some((f) => f.extension_m > kFootDown_m);
}
