import type { Vehicle } from "@/shared/api/types";

/** The bracket that departs too far from its end for the vehicle to drive; `share` of the end's mean, signed. What is heavier
 * or lies elsewhere than it may is another fault. */
export function bracketFault(
  vehicle: Pick<Vehicle, "worst_bracket" | "load_fault">,
): { bracket: string; share: number } | undefined {
  const worst = vehicle.worst_bracket;
  if (worst === undefined || vehicle.load_fault?.code !== "load_unbalanced") return undefined;
  return { bracket: worst.bracket, share: worst.share };
}
