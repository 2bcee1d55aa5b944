import type { StopRecord } from "@/shared/api/types";
import { kHalves_deg, kHalves_mm } from "./closeUp";
import { countedStops, series, type Series } from "./statistics";
import { rowCloseUp } from "./trendScale";

/** One deviation of the last stops, oldest first. */
export interface TrendData {
  name: string;
  unit: string;
  /** Its tolerance; all of a row is in the row's unit. */
  limit: number;
  data: Series;
  /** Half the height of the row as a close-up; undefined where the tolerance's own scale is as close. */
  closeUp: number | undefined;
}

const kDeg = 180 / Math.PI;

/** The three rows of the trend of `last`, against the tolerance of `stop`. */
export function trendRows(stop: StopRecord, last: readonly StopRecord[]): TrendData[] {
  const counted = countedStops(last);
  const row = (
    name: string,
    unit: string,
    halves: readonly number[],
    of: (s: StopRecord) => number,
    limit: number,
  ) => {
    const data = series(last.map(of), counted);
    return { name, unit, limit, data, closeUp: rowCloseUp(data, limit, halves) };
  };
  const { tolerance } = stop;
  return [
    row("dx", "mm", kHalves_mm, (s) => s.dx_m * 1000, tolerance.dx_m * 1000),
    row("dy", "mm", kHalves_mm, (s) => s.dy_m * 1000, tolerance.dy_m * 1000),
    row("dθ", "°", kHalves_deg, (s) => s.dheading_rad * kDeg, tolerance.dheading_rad * kDeg),
  ];
}
