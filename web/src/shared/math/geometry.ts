// Plane geometry for the screens. No React, no DOM. Hall frame: metres, y north, headings ccw from x.
export interface XY {
  x: number;
  y: number;
}
export interface MetricPoint {
  x_m: number;
  y_m: number;
}
export interface Box {
  minX: number;
  minY: number;
  maxX: number;
  maxY: number;
}

export function boxOf(points: readonly MetricPoint[]): Box {
  const box = { minX: Infinity, minY: Infinity, maxX: -Infinity, maxY: -Infinity };
  for (const p of points) {
    box.minX = Math.min(box.minX, p.x_m);
    box.minY = Math.min(box.minY, p.y_m);
    box.maxX = Math.max(box.maxX, p.x_m);
    box.maxY = Math.max(box.maxY, p.y_m);
  }
  return box;
}

export interface PoseLike extends MetricPoint {
  heading_rad: number;
}

/** Points of a body frame (x forward, y left) seen in the hall. */
export function placed(body: readonly MetricPoint[], pose: PoseLike): MetricPoint[] {
  const c = Math.cos(pose.heading_rad);
  const s = Math.sin(pose.heading_rad);
  return body.map((p) => ({ x_m: pose.x_m + c * p.x_m - s * p.y_m, y_m: pose.y_m + s * p.x_m + c * p.y_m }));
}

/** Whether `p` lies in the ring (even-odd rule; the edge counts as neither). */
export function inside(ring: readonly XY[], p: XY): boolean {
  let odd = false;
  for (let i = 0, j = ring.length - 1; i < ring.length; j = i++) {
    const a = ring[i]!;
    const b = ring[j]!;
    if (a.y > p.y !== b.y > p.y && p.x < ((b.x - a.x) * (p.y - a.y)) / (b.y - a.y) + a.x) odd = !odd;
  }
  return odd;
}

export function distanceToSegment(p: XY, a: XY, b: XY): number {
  const dx = b.x - a.x;
  const dy = b.y - a.y;
  const square = dx * dx + dy * dy;
  const t = square === 0 ? 0 : Math.max(0, Math.min(1, ((p.x - a.x) * dx + (p.y - a.y) * dy) / square));
  return Math.hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/** Distance from a ring's area: 0 inside. */
export function distanceToRing(ring: readonly XY[], p: XY): number {
  if (inside(ring, p)) return 0;
  let best = Infinity;
  for (let i = 0, j = ring.length - 1; i < ring.length; j = i++) {
    best = Math.min(best, distanceToSegment(p, ring[j]!, ring[i]!));
  }
  return best;
}

const crosses = (a: XY, b: XY, c: XY, d: XY): boolean => {
  const side = (p: XY, q: XY, r: XY) => Math.sign((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
  return side(a, b, c) !== side(a, b, d) && side(c, d, a) !== side(c, d, b);
};

/** Whether a ring and an upright box share any point. */
export function ringMeetsBox(ring: readonly XY[], box: Box): boolean {
  const corners: XY[] = [
    { x: box.minX, y: box.minY },
    { x: box.maxX, y: box.minY },
    { x: box.maxX, y: box.maxY },
    { x: box.minX, y: box.maxY },
  ];
  const within = (p: XY) => p.x >= box.minX && p.x <= box.maxX && p.y >= box.minY && p.y <= box.maxY;
  if (ring.some(within) || corners.some((corner) => inside(ring, corner))) return true;
  return ring.some((b, i) => {
    const a = ring[(i + ring.length - 1) % ring.length]!;
    return corners.some((d, k) => crosses(a, b, corners[(k + 3) % 4]!, d));
  });
}

export const boxesMeet = (a: Box, b: Box): boolean =>
  a.minX < b.maxX && b.minX < a.maxX && a.minY < b.maxY && b.minY < a.maxY;

/** Splits a path at the place nearest to `at`: what lies behind, what lies ahead. Both contain that place. */
export function splitPath<P extends MetricPoint>(
  path: readonly P[],
  at: MetricPoint,
): [MetricPoint[], MetricPoint[]] {
  let best = Infinity;
  let where = 0;
  let split: MetricPoint = path[0] ?? at;
  for (let i = 0; i + 1 < path.length; i++) {
    const a = path[i]!;
    const b = path[i + 1]!;
    const dx = b.x_m - a.x_m;
    const dy = b.y_m - a.y_m;
    const square = dx * dx + dy * dy;
    const t =
      square === 0 ? 0 : Math.max(0, Math.min(1, ((at.x_m - a.x_m) * dx + (at.y_m - a.y_m) * dy) / square));
    const p = { x_m: a.x_m + t * dx, y_m: a.y_m + t * dy };
    const d = Math.hypot(p.x_m - at.x_m, p.y_m - at.y_m);
    if (d < best) {
      best = d;
      where = i;
      split = p;
    }
  }
  return [
    [...path.slice(0, where + 1), split],
    [split, ...path.slice(where + 1)],
  ];
}
