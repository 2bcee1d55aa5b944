import { describe, expect, it } from "vitest";
import type { StopRecord } from "@/shared/api/types";
import {
  beginsClose,
  beyond,
  closeUpHalf,
  emptyCorner,
  kHalves_deg,
  kHalves_mm,
  plotReach_mm,
} from "./closeUp";
import { series } from "./statistics";
import { closeScale, ellipseLabel, marginOf, ticksOf } from "./targetScale";
import { rowCloseUp } from "./trendScale";

const stop = (dx_mm: number, dy_mm: number) => ({ dx_m: dx_mm / 1000, dy_m: dy_mm / 1000 }) as StopRecord;

describe("a close-up", () => {
  it.each([
    [0.5, 25, 1],
    [0.96, 25, 2], // a dot on the very edge would be cut
    [1.9, 25, 2],
    [4, 25, 5],
    [9, 25, 10],
    [10, 25, undefined], // 25 is the tolerance itself
    [23, 50, 25],
    [30, 60, 50],
    [49, 60, undefined],
    [0.4, 1, undefined],
    [0, 25, 1],
  ])("of what reaches %s mm, with a tolerance of %s mm, is of %s mm", (reach, limit, half) =>
    expect(closeUpHalf(reach, limit, kHalves_mm)).toBe(half),
  );
  it.each([
    [0.018, 0.2, 0.02],
    [0.037, 0.2, 0.05],
    [0.15, 0.2, undefined],
  ])("of what reaches %s degrees, with a tolerance of %s, is of %s", (reach, limit, half) =>
    expect(closeUpHalf(reach, limit, kHalves_deg)).toBe(half),
  );
  it("holds the farthest of all stops along either axis", () => {
    expect(plotReach_mm(stop(0.2, -0.4), [stop(-1.25, 0), stop(0, 0.9)])).toBeCloseTo(1.25);
    expect(plotReach_mm(stop(0.2, -0.4), [])).toBeCloseTo(0.4);
  });
  it.each([
    [1, 25, true],
    [5, 25, true],
    [10, 25, false], // the tolerance's picture tells the stops apart, and is the one that people know
    [undefined, 25, false],
  ])("of %s mm is shown first for a tolerance of %s mm: %s", (half, limit, first) =>
    expect(beginsClose(half, limit)).toBe(first),
  );
  it.each([
    [1, 25, 25, "both"],
    [10, 25, 5, "dx"],
    [10, 5, 25, "dy"],
    [30, 25, 25, "none"],
  ])("of %s mm has the tolerance %s, %s outside: %s", (half, x, y, sides) =>
    expect(beyond(half, { x, y })).toBe(sides),
  );
  it.each([
    [1, [-1, -0.5, 0, 0.5, 1]],
    [2, [-2, -1, 0, 1, 2]],
    [5, [-4, -2, 0, 2, 4]],
    [25, [-20, -10, 0, 10, 20]],
  ])("of %s mm has its grid at %j", (half, ticks) => expect(ticksOf(closeScale(half))).toEqual(ticks));
});

describe("what stands in a close-up", () => {
  it("has more room around it where its numbers have decimals", () => {
    expect(marginOf(closeScale(1)).view).toBeGreaterThan(marginOf(closeScale(2)).view);
  });
  it.each([
    [0.3, 0.2, { x: -1, y: -1 }],
    [-0.3, -0.2, { x: 1, y: 1 }],
    [-0.3, 0.2, { x: 1, y: -1 }],
  ])("the locator keeps away from a stop at %s, %s", (x, y, corner) =>
    expect(emptyCorner({ x, y })).toEqual(corner),
  );
  it("names the ellipse away from the stop's label, inside the plot, and not where it is a dot", () => {
    const ellipse = { cx: 0, cy: 0, rx: 1, ry: 2, angle_rad: 0 };

    expect(ellipseLabel(ellipse, { x: 0.6, y: -1 }, 2)).toEqual({ x: -0.75, y: 1.7 });
    expect(ellipseLabel(ellipse, { x: 0.6, y: -1 }, 1)).toEqual({ x: -0.75, y: 0.9 });
    expect(ellipseLabel(ellipse, { x: 0.6, y: -1 }, 25)).toBeUndefined();
  });
});

describe("a row of the trend as a close-up", () => {
  const of = (values: number[]) =>
    series(
      values,
      values.map(() => true),
    );
  it.each([
    ["its stops", [0.4, -0.3, 0.2], 25, 1],
    ["its control limits, too", [0.8, -0.8, 0.8, -0.8, 0.8, -0.8, 0.8, -0.8], 25, 5],
    ["its stops alone, where the limits are as wide as the tolerance", [3, -3, 3, -3, 3, -3, 3, -3], 10, 5],
    ["nothing that the tolerance's own scale does not show as well", [8, -8], 10, undefined],
  ])("holds %s", (_, values, limit, half) => expect(rowCloseUp(of(values), limit, kHalves_mm)).toBe(half));
});
