import type { Vehicle } from "@/shared/api/types";

/** The bracket that departs too far from its end for the vehicle to drive; `share` of the end's mean, signed. */
export function bracketFault(
  vehicle: Pick<Vehicle, "worst_bracket">,
): { bracket: string; share: number } | undefined {
  const worst = vehicle.worst_bracket;
  if (worst === undefined || Math.abs(worst.share) <= worst.limit) return undefined;
  return { bracket: worst.bracket, share: worst.share };
}
