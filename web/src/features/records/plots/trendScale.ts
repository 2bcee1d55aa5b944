import { closeUpHalf } from "./closeUp";
import type { Series } from "./statistics";

/** Control limits further out than this many tolerances are not drawn: they would flatten the row. */
export const kWidestReach = 3;

/** Half the height of a trend row in tolerances: all that counts fits, and the control limits while they can. */
export function trendReach(data: Series, limit: number): number {
  const kept = data.largest / limit + 0.08;
  const control = data.hasLimits ? Math.max(data.upper, -data.lower) / limit + 0.08 : 0;
  return Math.max(1.12, kept, Math.min(kWidestReach, control));
}

/** Half the height of a row's close-up: it holds all that counts, and the control limits where it stays closer than the tolerance. */
export function rowCloseUp(data: Series, limit: number, halves: readonly number[]): number | undefined {
  const control = data.hasLimits ? Math.max(data.upper, -data.lower) : 0;
  return (
    closeUpHalf(Math.max(data.largest, control), limit, halves) ?? closeUpHalf(data.largest, limit, halves)
  );
}

/** Control limits that lie inside a row of this half height. */
export function limitsWithin(data: Series, top: number): number[] {
  return data.hasLimits ? [data.upper, data.lower].filter((v) => Math.abs(v) <= top) : [];
}

/** Runs of neighbouring stops that are in scale: the line breaks at the others. */
export function unbroken(data: Pick<Series, "inScale">): number[][] {
  const runs: number[][] = [];
  let run: number[] = [];
  data.inScale.forEach((ok, i) => {
    if (ok) run.push(i);
    else if (run.length > 0) {
      runs.push(run);
      run = [];
    }
  });
  if (run.length > 0) runs.push(run);
  return runs;
}

/** Decimals that print a limit or a grid step without rounding it away: 25, 12.5, 0.5, 0.05. */
export function limitDecimals(limit: number): number {
  for (let decimals = 0; decimals < 3; ++decimals) {
    if (Math.abs(Number(limit.toFixed(decimals)) - limit) <= Math.abs(limit) * 0.005) return decimals;
  }
  return 3;
}
