import type { Plant, Point, Ring, Vehicle } from "@/shared/api/types";
import { placed } from "@/shared/math/geometry";

/** What a move comes nearest to, as the server names it, as outlines; undefined where the plan has no outline of it. */
export function nearestBody(
  name: string | undefined,
  vehicles: readonly Vehicle[],
  plant: Plant,
  hall: string | undefined,
): Ring[] | undefined {
  if (name === undefined || name === "") return undefined;
  if (name === "wall") {
    const outline = plant.halls.find((h) => hall === undefined || h.id === hall)?.outline;
    return outline && [outline];
  }
  const area = plant.areas.find((a) => a.id === name);
  if (area) return [area.outline];
  const other = vehicles.find((v) => v.id === name);
  const type = plant.vehicle_types.find((t) => t.id === other?.type);
  if (other?.pose === undefined || type === undefined) return undefined;
  const { pose } = other;
  const loaded = other.load_kg > 0 || other.load_name !== "";
  return [type.footprint, ...(loaded ? [type.load_footprint] : [])].map((body) => placed(body, pose));
}

/** Where the swept area and the outlines come nearest to each other; undefined where they touch. */
export function clearanceLine(
  swept: readonly Ring[],
  outlines: readonly Ring[],
): { from: Point; to: Point } | undefined {
  let best: { from: Point; to: Point } | undefined;
  let least = Infinity;
  for (const a of swept)
    for (const b of outlines)
      for (const [from, to] of [...pairs(a, b), ...pairs(b, a).map(([p, q]) => [q, p] as const)]) {
        const d = Math.hypot(to.x_m - from.x_m, to.y_m - from.y_m);
        if (d >= least) continue;
        least = d;
        best = { from, to };
      }
  return least > kTouches_m ? best : undefined;
}

const kTouches_m = 0.02;

/** Each corner of `a` with the place on an edge of `b` that is nearest to it. */
function pairs(a: Ring, b: Ring): (readonly [Point, Point])[] {
  return a.flatMap((p) =>
    b.map((end, i) => [p, nearestOn(b[(i + b.length - 1) % b.length] ?? end, end, p)] as const),
  );
}

function nearestOn(a: Point, b: Point, p: Point): Point {
  const dx = b.x_m - a.x_m;
  const dy = b.y_m - a.y_m;
  const square = dx * dx + dy * dy;
  const share =
    square === 0 ? 0 : Math.max(0, Math.min(1, ((p.x_m - a.x_m) * dx + (p.y_m - a.y_m) * dy) / square));
  return { x_m: a.x_m + share * dx, y_m: a.y_m + share * dy };
}
