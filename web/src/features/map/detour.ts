import type { Leg, Plant } from "@/shared/api/types";

/** Less than this is no detour that anybody wonders about. */
const kLeast_m = 30;
const kLeastTimes = 1.5;
/** A drive begins at a node or near one; and the way that was chosen may be a little longer than the shortest. */
const kNear_m = 4;
const kSlack = 1.1;

export interface LongWay {
  driven_m: number;
  direct_m: number;
}

type Roads = ReadonlyMap<string, readonly { to: string; length_m: number }[]>;

/** A drive that is long because lanes are one way: how far it goes, and how far it would be against their arrows. */
export function longWay(
  plant: Plant,
  type: string,
  leg: Pick<Leg, "path" | "station">,
  closed: ReadonlySet<string>,
): LongWay | undefined {
  const nodes = new Map(plant.roadmap.nodes.map((n) => [n.id, n.position]));
  const goal = plant.stations.find((s) => s.id === leg.station)?.node;
  const [start] = leg.path;
  if (goal === undefined || start === undefined) return undefined;
  const driven_m = leg.path
    .slice(1)
    .reduce((sum, b, i) => sum + Math.hypot(b.x_m - leg.path[i]!.x_m, b.y_m - leg.path[i]!.y_m), 0);
  if (driven_m < kLeast_m) return undefined;

  const lanes = plant.roadmap.edges.flatMap((e) => {
    const [a, b] = [nodes.get(e.from), nodes.get(e.to)];
    const only = e.vehicle_types ?? [];
    if (a === undefined || b === undefined || closed.has(e.id)) return [];
    if (only.length > 0 && !only.includes(type)) return [];
    return [{ from: e.from, to: e.to, length_m: Math.hypot(b.x_m - a.x_m, b.y_m - a.y_m) }];
  });
  const roads = (both: boolean): Roads => {
    const out = new Map<string, { to: string; length_m: number }[]>();
    const add = (from: string, to: string, length_m: number) =>
      out.set(from, [...(out.get(from) ?? []), { to, length_m }]);
    for (const { from, to, length_m } of lanes) {
      add(from, to, length_m);
      if (both) add(to, from, length_m);
    }
    return out;
  };
  const usable = new Set(lanes.flatMap((lane) => [lane.from, lane.to]));
  const begin = [...nodes]
    .filter(([id]) => usable.has(id))
    .map(([id, p]) => ({ id, off_m: Math.hypot(p.x_m - start.x_m, p.y_m - start.y_m) }))
    .sort((a, b) => a.off_m - b.off_m)[0];
  if (begin === undefined || begin.off_m > kNear_m) return undefined;
  const direct_m = shortest(roads(true), begin.id, goal);
  const ruled_m = shortest(roads(false), begin.id, goal);
  // Long for another cause, such as closed floor or others in the way: then nothing is said of arrows.
  if (direct_m === undefined || ruled_m === undefined || driven_m > ruled_m * kSlack + kNear_m)
    return undefined;
  const long = driven_m - direct_m >= kLeast_m && driven_m >= kLeastTimes * direct_m;
  return long ? { driven_m, direct_m } : undefined;
}

/** Length of the shortest way (Dijkstra); a plant has some hundred nodes, so the nearest is simply looked for. */
function shortest(roads: Roads, from: string, to: string): number | undefined {
  const reached = new Map([[from, 0]]);
  const done = new Set<string>();
  for (;;) {
    let at: string | undefined;
    for (const [id, d] of reached) if (!done.has(id) && (at === undefined || d < reached.get(at)!)) at = id;
    if (at === undefined) return undefined;
    if (at === to) return reached.get(at);
    done.add(at);
    for (const road of roads.get(at) ?? []) {
      const d = reached.get(at)! + road.length_m;
      if (d < (reached.get(road.to) ?? Infinity)) reached.set(road.to, d);
    }
  }
}
