import type { LegAlternative, Plant } from "@/shared/api/types";

/** Numbers of the stations that a way of roadmap nodes leads past, in its order; start and end are known anyhow. */
export function passes(way: Pick<LegAlternative, "route">, plant: Plant | undefined): number[] {
  const numbers = new Map((plant?.stations ?? []).map((s) => [s.node, s.number]));
  return way.route.slice(1, -1).flatMap((node) => numbers.get(node) ?? []);
}
