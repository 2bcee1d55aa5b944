import type { Load, Point, VehicleType } from "@/shared/api/types";
import { fixed } from "@/shared/words/format";

/** What is drawn of a load, in metres, in the body frame of the vehicle below it: forward is right, left is up. */
export interface LoadSheet {
  outline: readonly Point[];
  /** Nobody has told its outline: drawn is what the type usually carries. */
  usual: boolean;
  /** Of the vehicle below it. */
  body: readonly Point[];
  brackets: readonly Point[];
  /** Of gravity. */
  centre: Point;
  /** Where the type lets it be. */
  allowed: readonly Point[];
  box: { left: number; top: number; width: number; height: number };
  /** Length of the scale's line. */
  scale_m: number;
}

const kRoom = 0.08; // round what is drawn, as a share of its length

/** Which type to draw it on: that of the vehicle that has it, else the first that may carry it. */
export function sheetOf(load: Load, type: VehicleType | undefined): LoadSheet {
  const own = load.outline ?? [];
  const usual = own.length === 0;
  const outline = usual ? (type?.load_footprint ?? []) : own;
  const body = type?.footprint ?? [];
  const brackets = type?.brackets.map(({ position }) => position) ?? [];
  const mean = (pick: (p: Point) => number) =>
    brackets.length === 0 ? 0 : brackets.reduce((sum, p) => sum + pick(p), 0) / brackets.length;
  const centre = {
    x_m: mean((p) => p.x_m) + load.centre.x_m,
    y_m: mean((p) => p.y_m) + load.centre.y_m,
  };
  const all = [...outline, ...body, ...brackets, centre];
  const xs = all.map((p) => p.x_m);
  const ys = all.map((p) => -p.y_m);
  const [left, right, top, bottom] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const room = Math.max(kRoom * Math.max(right - left, bottom - top), 0.25);
  return {
    outline,
    usual,
    body,
    brackets,
    centre,
    allowed: type?.load_rules?.centre ?? [],
    box: {
      left: left - room,
      top: top - room,
      width: right - left + 2 * room,
      height: bottom - top + 3 * room, // below it lies the scale
    },
    scale_m: scaleOf(right - left),
  };
}

/** A round length, about a fifth of what is drawn. */
export function scaleOf(length_m: number): number {
  const kRound = [10, 5, 2, 1, 0.5, 0.2];
  return kRound.find((one) => one <= length_m / 4) ?? 0.1;
}

/** Length and width in metres, as words need them; undefined without an outline. */
export function sizeOf(outline: readonly Point[]): { length: string; width: string } | undefined {
  if (outline.length === 0) return undefined;
  const span = (values: number[]) => fixed(Math.max(...values) - Math.min(...values), 2);
  return { length: span(outline.map((p) => p.x_m)), width: span(outline.map((p) => p.y_m)) };
}
