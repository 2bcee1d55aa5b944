import type { StopRecord } from "@/shared/api/types";

/** Half the width of the plot in mm and its grid step: the tolerance fills 5/6, a far stop widens it. */
export function plotScale(stop: StopRecord): { half: number; step: number } {
  const tolerance = Math.max(stop.tolerance.dx_m, stop.tolerance.dy_m) * 1000;
  const own = Math.max(Math.abs(stop.dx_m), Math.abs(stop.dy_m)) * 1000;
  const base = tolerance * 1.2;
  const half = own > base * 0.92 ? own * 1.2 : base;
  return { half, step: niceStep(half / 3) };
}

/** 1, 2, 5 times a power of ten. */
export function niceStep(about: number): number {
  const power = 10 ** Math.floor(Math.log10(about));
  const share = about / power;
  return (share >= 5 ? 5 : share >= 2 ? 2 : 1) * power;
}

/** Heading drawn so many times larger than it is; less when the tolerance is wide. */
export function headingFactor(stop: StopRecord): number {
  const degrees = (stop.tolerance.dheading_rad * 180) / Math.PI;
  return degrees * 100 <= 45 ? 100 : degrees * 10 <= 60 ? 10 : 1;
}

/** The label stands on the side of the stop that has more room. */
export function labelSide(x: number, half: number): 1 | -1 {
  return x > half * 0.25 ? -1 : x < -half * 0.6 ? 1 : x < 0 ? -1 : 1;
}
