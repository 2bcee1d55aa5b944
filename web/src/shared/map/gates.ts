import type { Area, Point, Ring } from "@/shared/api/types";

/** A gate in the wall, from `a` to `b`; its leaves swing into the hall along `inward`. */
export interface Gate {
  a: Point;
  b: Point;
  inward: Point;
}

const kOnWall_m = 0.05;
/** A plant file has no kind for gates. They are floor to be kept free at the wall, and are called what they are. */
const kNamed = /^(gate|door)\b/i;

const distanceToLine = (p: Point, a: Point, b: Point): number => {
  const length = Math.hypot(b.x_m - a.x_m, b.y_m - a.y_m);
  if (length === 0) return Infinity;
  return Math.abs((b.x_m - a.x_m) * (p.y_m - a.y_m) - (b.y_m - a.y_m) * (p.x_m - a.x_m)) / length;
};

export function gatesOf(areas: readonly Area[], outline: Ring): Gate[] {
  const walls = outline.map((b, i) => [outline[(i + outline.length - 1) % outline.length]!, b] as const);
  return areas.flatMap((area) => {
    if (area.kind !== "no_go" || !kNamed.test(area.id)) return [];
    const n = area.outline.length;
    for (let i = 0; i < n; i++) {
      const a = area.outline[i]!;
      const b = area.outline[(i + 1) % n]!;
      const wall = walls.find(
        ([p, q]) => distanceToLine(a, p, q) < kOnWall_m && distanceToLine(b, p, q) < kOnWall_m,
      );
      if (wall === undefined) continue;
      const middle = {
        x_m: area.outline.reduce((sum, p) => sum + p.x_m, 0) / n,
        y_m: area.outline.reduce((sum, p) => sum + p.y_m, 0) / n,
      };
      const off = { x_m: middle.x_m - (a.x_m + b.x_m) / 2, y_m: middle.y_m - (a.y_m + b.y_m) / 2 };
      const length = Math.hypot(off.x_m, off.y_m) || 1;
      return [{ a, b, inward: { x_m: off.x_m / length, y_m: off.y_m / length } }];
    }
    return [];
  });
}
