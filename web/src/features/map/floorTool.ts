import type { Closure, Point } from "@/shared/api/types";
import type { Lane } from "@/shared/map";
import { distanceToSegment } from "@/shared/math/geometry";

/** Floor a person is about to close: lanes, or the area between two corners. */
export interface FloorDraft {
  how: "lanes" | "area";
  edges: readonly string[];
  corner: Point | undefined;
  area: readonly [Point, Point] | undefined;
}

export const emptyFloor: FloorDraft = { how: "lanes", edges: [], corner: undefined, area: undefined };

const kLeastSideM = 0.2;

/** The lane under a finger; both directions of a pair are one. */
export function laneAt(lanes: readonly Lane[], at: Point, reach_m: number): Lane | undefined {
  const p = { x: at.x_m, y: at.y_m };
  let best: Lane | undefined;
  let least = reach_m;
  for (const lane of lanes) {
    const d = distanceToSegment(p, { x: lane.ax, y: lane.ay }, { x: lane.bx, y: lane.by });
    if (d < least) {
      least = d;
      best = lane;
    }
  }
  return best;
}

/** What a press on the map makes of the draft. A press beside all lanes begins an area. */
export function pressed(draft: FloorDraft, lanes: readonly Lane[], at: Point, reach_m: number): FloorDraft {
  if (draft.how === "lanes") {
    const lane = laneAt(lanes, at, reach_m);
    if (lane !== undefined) {
      const on = lane.edges.some((edge) => draft.edges.includes(edge));
      const others = draft.edges.filter((edge) => !lane.edges.includes(edge));
      return { ...draft, edges: on ? others : [...others, ...lane.edges] };
    }
    if (draft.edges.length > 0) return draft;
  }
  if (draft.corner === undefined) return { ...emptyFloor, how: "area", corner: at };
  const { corner } = draft;
  const isArea = Math.abs(at.x_m - corner.x_m) >= kLeastSideM && Math.abs(at.y_m - corner.y_m) >= kLeastSideM;
  return isArea ? { ...emptyFloor, how: "area", area: [corner, at] } : draft;
}

/** The outline between two opposite corners, counter-clockwise. */
export function outlineOf([a, b]: readonly [Point, Point]): Point[] {
  const [x0, x1] = [Math.min(a.x_m, b.x_m), Math.max(a.x_m, b.x_m)];
  const [y0, y1] = [Math.min(a.y_m, b.y_m), Math.max(a.y_m, b.y_m)];
  return [
    { x_m: x0, y_m: y0 },
    { x_m: x1, y_m: y0 },
    { x_m: x1, y_m: y1 },
    { x_m: x0, y_m: y1 },
  ];
}

export type NewClosure = { name: string; hall?: string; outline?: Point[]; edges?: string[] };

/** The body of POST /closures; undefined while there is nothing to close. */
export function toClosure(draft: FloorDraft, name: string, hall: string): NewClosure | undefined {
  if (draft.area !== undefined) return { name, hall, outline: outlineOf(draft.area) };
  return draft.edges.length > 0 ? { name, edges: [...draft.edges] } : undefined;
}

/** How many lanes these edges are; a pair is one. */
export function laneCount(edges: readonly string[], lanes: readonly Lane[]): number {
  return lanes.filter((lane) => lane.edges.some((e) => edges.includes(e))).length;
}

/** Size of a closure for its row: lanes (a pair is one) or width and height of its area. */
export function sizeOf(
  closure: Pick<Closure, "outline" | "edges">,
  lanes: readonly Lane[],
): { kind: "area"; x_m: number; y_m: number } | { kind: "lanes"; count: number } {
  const { outline } = closure;
  if (outline !== undefined && outline.length > 2) {
    const xs = outline.map((p) => p.x_m);
    const ys = outline.map((p) => p.y_m);
    return { kind: "area", x_m: Math.max(...xs) - Math.min(...xs), y_m: Math.max(...ys) - Math.min(...ys) };
  }
  return { kind: "lanes", count: laneCount(closure.edges, lanes) };
}
