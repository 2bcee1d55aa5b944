import type { Plant, Point, Pose, Ring, Station } from "@/shared/api/types";

/** A window on the hall, in metres; y grows north. */
export interface View {
  left: number;
  bottom: number;
  width: number;
  height: number;
}

export function boundsOf(rings: readonly Ring[]): { min: Point; max: Point } | undefined {
  const min = { x_m: Infinity, y_m: Infinity };
  const max = { x_m: -Infinity, y_m: -Infinity };
  for (const ring of rings) {
    for (const p of ring) {
      min.x_m = Math.min(min.x_m, p.x_m);
      min.y_m = Math.min(min.y_m, p.y_m);
      max.x_m = Math.max(max.x_m, p.x_m);
      max.y_m = Math.max(max.y_m, p.y_m);
    }
  }
  return min.x_m <= max.x_m ? { min, max } : undefined;
}

/** The smallest window of the given shape that shows all rings with a margin round them. */
export function viewOf(
  rings: readonly Ring[],
  aspect: number,
  margin = 0.12,
  least_m = 12,
): View | undefined {
  const box = boundsOf(rings);
  if (!box || !(aspect > 0)) return undefined;
  let width = Math.max(least_m, box.max.x_m - box.min.x_m) * (1 + 2 * margin);
  let height = Math.max(least_m / aspect, box.max.y_m - box.min.y_m) * (1 + 2 * margin);
  if (width / height < aspect) width = height * aspect;
  else height = width / aspect;
  const cx = (box.min.x_m + box.max.x_m) / 2;
  const cy = (box.min.y_m + box.max.y_m) / 2;
  return { left: cx - width / 2, bottom: cy - height / 2, width, height };
}

/** Place in the window as shares from its left and top edge. */
export function toShare(view: View, p: Point): { x: number; y: number } {
  return { x: (p.x_m - view.left) / view.width, y: 1 - (p.y_m - view.bottom) / view.height };
}

export function inView(view: View, p: Point): boolean {
  const s = toShare(view, p);
  return s.x > 0.01 && s.x < 0.99 && s.y > 0.01 && s.y < 0.99;
}

/** SVG path of rings; y is flipped by the drawing's transform, not here. */
export function ringPath(rings: readonly Ring[]): string {
  return rings
    .filter((ring) => ring.length > 2)
    .map((ring) => `M${ring.map((p) => `${round(p.x_m)} ${round(p.y_m)}`).join("L")}Z`)
    .join("");
}

export function linePath(points: readonly Point[]): string {
  return points.length < 2 ? "" : `M${points.map((p) => `${round(p.x_m)} ${round(p.y_m)}`).join("L")}`;
}

/** A body outline at a pose of the hall. */
export function placed(ring: Ring, pose: Pose): Ring {
  const c = Math.cos(pose.heading_rad);
  const s = Math.sin(pose.heading_rad);
  return ring.map((p) => ({
    x_m: pose.x_m + c * p.x_m - s * p.y_m,
    y_m: pose.y_m + s * p.x_m + c * p.y_m,
  }));
}

const kFrameGap_m = 0.35;

/** Half length and half width of a station: of the largest vehicle that stops there, and a little more. */
export function stationFrame(plant: Plant, station: Station): Point {
  const types = plant.vehicle_types.filter(
    (t) => station.vehicle_types.length === 0 || station.vehicle_types.includes(t.id),
  );
  const corners = types.flatMap((t) => t.footprint);
  return {
    x_m: Math.max(0, ...corners.map((p) => Math.abs(p.x_m))) + kFrameGap_m,
    y_m: Math.max(0, ...corners.map((p) => Math.abs(p.y_m))) + kFrameGap_m,
  };
}

interface Segment {
  kind: "rotate" | "straight" | "arc" | "combined";
  start: Pose;
  end: Pose;
  turn_rad: number;
  centre?: Point | undefined;
}

/** Way of the body's centre; arcs as short chords. */
export function wayOf(segments: readonly Segment[]): Point[] {
  const way: Point[] = [];
  for (const s of segments) {
    if (s.kind === "rotate") continue;
    if (way.length === 0) way.push({ x_m: s.start.x_m, y_m: s.start.y_m });
    if (s.kind === "arc" && s.centre) {
      const { x_m: cx, y_m: cy } = s.centre;
      const radius = Math.hypot(s.start.x_m - cx, s.start.y_m - cy);
      const from = Math.atan2(s.start.y_m - cy, s.start.x_m - cx);
      const steps = Math.max(2, Math.ceil(Math.abs(s.turn_rad) / (Math.PI / 60)));
      for (let i = 1; i < steps; ++i) {
        const angle = from + (s.turn_rad * i) / steps;
        way.push({ x_m: cx + radius * Math.cos(angle), y_m: cy + radius * Math.sin(angle) });
      }
    }
    way.push({ x_m: s.end.x_m, y_m: s.end.y_m });
  }
  return way;
}

/** Arc of a turn on the spot, drawn at `radius_m` round the body's centre. */
export function turnArc(s: Segment, radius_m: number): Point[] {
  const steps = Math.max(2, Math.ceil(Math.abs(s.turn_rad) / (Math.PI / 60)));
  return Array.from({ length: steps + 1 }, (_, i) => {
    const angle = s.start.heading_rad + (s.turn_rad * i) / steps;
    return { x_m: s.start.x_m + radius_m * Math.cos(angle), y_m: s.start.y_m + radius_m * Math.sin(angle) };
  });
}

const round = (v: number): number => Math.round(v * 1000) / 1000;

/** A dimension beside a straight drive: where its line and its two extension lines run. */
export interface Dimension {
  from: Point;
  to: Point;
  extensions: [Point[], Point[]];
}

const kDimensionGap_m = 1.6;

/** Only for one straight drive: beside the swept area, on the side where that reaches less far. */
export function dimension(way: readonly Point[], swept: readonly Ring[]): Dimension | undefined {
  const [a, b] = way;
  if (way.length !== 2 || !a || !b) return undefined;
  const length = Math.hypot(b.x_m - a.x_m, b.y_m - a.y_m);
  if (length < 0.5) return undefined;
  const n = { x: (b.y_m - a.y_m) / length, y: -(b.x_m - a.x_m) / length }; // to the right of the drive
  let right = 1.5;
  let left = 1.5;
  for (const p of swept.flat()) {
    const off = (p.x_m - a.x_m) * n.x + (p.y_m - a.y_m) * n.y;
    right = Math.max(right, off);
    left = Math.max(left, -off);
  }
  const out = right <= left ? right + kDimensionGap_m : -(left + kDimensionGap_m);
  const move = (p: Point, by: number): Point => ({ x_m: p.x_m + n.x * by, y_m: p.y_m + n.y * by });
  const past = out + Math.sign(out) * 0.4;
  return {
    from: move(a, out),
    to: move(b, out),
    extensions: [
      [move(a, Math.sign(out) * 1.6), move(a, past)],
      [move(b, Math.sign(out) * 1.6), move(b, past)],
    ],
  };
}

/** The station nearest to a press, at shares of the window; none within `reach` (share of the width). */
export function nearestStation(
  plant: Plant,
  hall: string | undefined,
  view: View,
  at: { x: number; y: number },
  reach: number,
): number | undefined {
  let best: number | undefined;
  let least = reach;
  for (const station of plant.stations) {
    if (station.hall !== hall) continue;
    const s = toShare(view, station.pose);
    const distance = Math.hypot(s.x - at.x, ((s.y - at.y) * view.height) / view.width);
    if (distance < least) {
      least = distance;
      best = station.number;
    }
  }
  return best;
}
