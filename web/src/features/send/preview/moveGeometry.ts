import type { Point, Pose, Ring } from "@/shared/api/types";
import type { Dimension } from "@/shared/map";

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

const kDimensionGap_m = 1.6;

/** Only for one straight drive: beside the swept area, on the side where that reaches less far. */
export function dimension(
  way: readonly Point[],
  swept: readonly Ring[],
): Omit<Dimension, "text"> | undefined {
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
