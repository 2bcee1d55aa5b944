import type { StopRecord } from "@/shared/api/types";
import type { Ellipse } from "./statistics";

/** Half the width of a plot in mm, and its grid step. */
export interface PlotScale {
  half: number;
  step: number;
}

/**
 * Half the width of the plot with the numbers around it, and where these stand, as shares of the plot: numbers with decimals are
 * wider, and on a phone they would be cut.
 */
export function marginOf({ step }: PlotScale): { view: number; numbers: number } {
  return Number.isInteger(step) ? { view: 1.133, numbers: 1.08 } : { view: 1.2, numbers: 1.1 };
}

/** Values at which the grid has a line. */
export function ticksOf({ half, step }: PlotScale): number[] {
  const count = Math.floor(half / step + 1e-9);
  return Array.from({ length: 2 * count + 1 }, (_, i) => Math.round((i - count) * step * 1000) / 1000);
}

/** A close-up: grid lines at about halves of it. */
export function closeScale(half: number): PlotScale {
  return { half, step: niceStep(half / 2) };
}

/** The whole tolerance: it fills 5/6 of the plot, a stop farther out widens it. */
export function toleranceScale(stop: StopRecord): PlotScale {
  const tolerance = Math.max(stop.tolerance.dx_m, stop.tolerance.dy_m) * 1000;
  const own = Math.max(Math.abs(stop.dx_m), Math.abs(stop.dy_m)) * 1000;
  const base = tolerance * 1.2;
  const half = own > base * 0.92 ? own * 1.2 : base;
  return { half, step: niceStep(half / 3) };
}

/** 1, 2, 5 times a power of ten. The small allowance: 0.6 / 3 is a little less than 0.2. */
export function niceStep(about: number): number {
  const wanted = about * (1 + 1e-9);
  const power = 10 ** Math.floor(Math.log10(wanted));
  const share = wanted / power;
  return (share >= 5 ? 5 : share >= 2 ? 2 : 1) * power;
}

/** Widest angle at which a heading is drawn. */
const kWidest_deg = 60;

/** Heading drawn so many times larger than it is; less when the tolerance or this heading would turn too far. */
export function headingFactor(stop: StopRecord): number {
  const degrees = (rad: number) => (Math.abs(rad) * 180) / Math.PI;
  const fits = (factor: number) =>
    degrees(stop.tolerance.dheading_rad) * factor <= 45 && degrees(stop.dheading_rad) * factor <= kWidest_deg;
  return [100, 10].find(fits) ?? 1;
}

/** Length of the heading's ray from a stop at height `y`, so that it ends inside the plot. */
export function rayLength(y: number, half: number): number {
  return Math.max(half * 0.22, Math.min(half * 0.5, half * 0.98 - y));
}

/** The tolerance is written above its corner, or below when this stop stands near that corner. */
export function toleranceLabelSide(at: { x: number; y: number }, half: number): 1 | -1 {
  return at.x > -half * 0.1 && at.y > half * 0.2 ? -1 : 1;
}

/** The label stands on the side of the stop that has more room. */
export function labelSide(x: number, half: number): 1 | -1 {
  return x > half * 0.25 ? -1 : x < -half * 0.6 ? 1 : x < 0 ? -1 : 1;
}

/** A spread this small against the plot is hidden under its own label. */
const kLeastSpread = 0.15;

/** Where "95 %" stands: at the corner of the ellipse farthest from the stop's label, and inside the plot; nowhere when too small. */
export function ellipseLabel(
  ellipse: Ellipse,
  label: { x: number; y: number },
  half: number,
): { x: number; y: number } | undefined {
  if (Math.max(ellipse.rx, ellipse.ry) < half * kLeastSpread) return undefined;
  const within = (v: number) => Math.max(-half * 0.9, Math.min(half * 0.9, v));
  const corners = [1, -1].flatMap((right) =>
    [1, -1].map((up) => ({
      x: within(ellipse.cx + right * ellipse.rx * 0.75),
      y: within(ellipse.cy + up * ellipse.ry * 0.85),
    })),
  );
  const far = (p: { x: number; y: number }) => Math.hypot(p.x - label.x, p.y - label.y);
  return corners.reduce((a, b) => (far(b) > far(a) ? b : a));
}
