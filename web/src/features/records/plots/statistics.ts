import type { StopRecord } from "@/shared/api/types";

export interface Ellipse {
  cx: number;
  cy: number;
  rx: number;
  ry: number;
  angle_rad: number; // of the long axis, counter-clockwise from x
}

/** Quantile 0.95 of chi-squared with two degrees of freedom. */
const kChi2 = 5.991;

/** Where 95 % of the stops are expected, from their mean and covariance. Needs three. */
export function ellipse95(points: readonly { x: number; y: number }[]): Ellipse | undefined {
  const n = points.length;
  if (n < 3) return undefined;
  const cx = points.reduce((s, p) => s + p.x, 0) / n;
  const cy = points.reduce((s, p) => s + p.y, 0) / n;
  let sxx = 0;
  let syy = 0;
  let sxy = 0;
  for (const p of points) {
    sxx += (p.x - cx) ** 2;
    syy += (p.y - cy) ** 2;
    sxy += (p.x - cx) * (p.y - cy);
  }
  sxx /= n - 1;
  syy /= n - 1;
  sxy /= n - 1;
  const mean = (sxx + syy) / 2;
  const diff = Math.hypot((sxx - syy) / 2, sxy);
  return {
    cx,
    cy,
    rx: Math.sqrt(kChi2 * (mean + diff)),
    ry: Math.sqrt(kChi2 * Math.max(0, mean - diff)),
    angle_rad: 0.5 * Math.atan2(2 * sxy, sxx - syy),
  };
}

export interface Series {
  values: number[];
  inScale: boolean[];
  meanAbs: number;
  largest: number;
  lower: number; // control limits: mean -+ 3 sigma from the mean moving range
  upper: number;
  hasLimits: boolean;
}

/** d2 of a moving range of two: sigma = mean range / 1.128. */
const kD2 = 1.128;

/** A stop this many times outside tolerance is drawn at the edge of the trend. */
export const kTrendScale = 1.1;

/**
 * Stops that count in the trend: one off scale in any direction counts in none, since a
 * remote-controlled arrival says nothing about the automatic ones.
 */
export function countedStops(stops: readonly StopRecord[]): boolean[] {
  return stops.map(
    (s) =>
      Math.abs(s.dx_m) <= s.tolerance.dx_m * kTrendScale &&
      Math.abs(s.dy_m) <= s.tolerance.dy_m * kTrendScale &&
      Math.abs(s.dheading_rad) <= s.tolerance.dheading_rad * kTrendScale,
  );
}

/** One row of the trend. Only stops that count make its figures and its control limits. */
export function series(values: readonly number[], inScale: readonly boolean[]): Series {
  const kept = values.filter((_, i) => inScale[i]);
  const n = kept.length;
  const mean = n ? kept.reduce((s, v) => s + v, 0) / n : 0;
  let range = 0;
  for (let i = 1; i < n; ++i) range += Math.abs((kept[i] ?? 0) - (kept[i - 1] ?? 0));
  const hasLimits = n >= 8; // fewer make limits that mean nothing
  const sigma = n > 1 ? range / (n - 1) / kD2 : 0;
  return {
    values: [...values],
    inScale: [...inScale],
    meanAbs: n ? kept.reduce((s, v) => s + Math.abs(v), 0) / n : 0,
    largest: n ? Math.max(...kept.map(Math.abs)) : 0,
    lower: mean - 3 * sigma,
    upper: mean + 3 * sigma,
    hasLimits,
  };
}

/** A tolerance that the process cannot hold: its control limits reach outside. */
export function widerThanTolerance(s: Series, limit: number): boolean {
  return s.hasLimits && (s.upper > limit || s.lower < -limit);
}

/** Oldest first, ending with `current`; stops after it are left out so that its page never changes. */
export function upTo(stops: readonly StopRecord[], current: StopRecord, count: number): StopRecord[] {
  const byTime = [...stops.filter((s) => s.id !== current.id && s.at <= current.at), current];
  byTime.sort((a, b) => (a.at < b.at ? -1 : a.at > b.at ? 1 : a.id < b.id ? -1 : 1));
  const end = byTime.findIndex((s) => s.id === current.id) + 1;
  return byTime.slice(Math.max(0, end - count), end);
}

/** Length of a deviation, as the station's tolerance is read. */
export function distance_m(stop: StopRecord): number {
  return Math.hypot(stop.dx_m, stop.dy_m);
}
