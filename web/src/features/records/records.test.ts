import { describe, expect, it } from "vitest";
import type { FleetEvent, StopRecord } from "@/shared/api/types";
import { countedStops, ellipse95, series, upTo, widerThanTolerance, type Series } from "./plots/statistics";
import { headingFactor, niceStep, toleranceScale, rayLength, toleranceLabelSide } from "./plots/targetScale";
import { limitDecimals, limitsWithin, trendReach, unbroken } from "./plots/trendScale";
import { listedStops, matches, mergeStops, resultOf, wantsOlder } from "./stopLists";

const tolerance = { shape: "box" as const, dx_m: 0.025, dy_m: 0.025, dheading_rad: (0.2 * Math.PI) / 180 };
const stop = (id: string, at: string, over: Partial<StopRecord> = {}): StopRecord =>
  ({
    id,
    at,
    dx_m: 0,
    dy_m: 0,
    dheading_rad: 0,
    tolerance,
    vehicle: "TP-01",
    number: 7,
    ...over,
  }) as StopRecord;
const all = (n: number) => Array.from({ length: n }, () => true);

describe("ellipse95", () => {
  it("lies along the spread", () => {
    const e = ellipse95([
      { x: -2, y: -2 },
      { x: 0, y: 0 },
      { x: 2, y: 2 },
    ]);

    expect(e?.angle_rad).toBeCloseTo(Math.PI / 4, 12);
    expect(e?.ry).toBeCloseTo(0, 6);
    expect(e?.rx).toBeCloseTo(Math.sqrt(5.991 * 8), 6);
  });
  it("needs three stops", () =>
    expect(
      ellipse95([
        { x: 0, y: 0 },
        { x: 1, y: 1 },
      ]),
    ).toBeUndefined());
});

describe("trend", () => {
  it("leaves a stop that is off scale in one direction out of every row", () => {
    const stops = [stop("a", "1"), stop("b", "2", { dx_m: 0.0512, dy_m: 0.001 })];

    expect(countedStops(stops)).toEqual([true, false]);
    expect(series([1, 99], countedStops(stops))).toMatchObject({ largest: 1, meanAbs: 1 });
  });
  it("has limits three sigma of the moving range round the mean", () => {
    const s = series([1, -1, 1, -1, 1, -1, 1, -1], all(8));

    expect(s.upper).toBeCloseTo((3 * 2) / 1.128, 9);
    expect(s.lower).toBeCloseTo(-s.upper, 9);
    expect(widerThanTolerance(s, 5)).toBe(true);
    expect(widerThanTolerance(s, 6)).toBe(false);
  });
  it("has no limits from seven stops", () =>
    expect(series([1, 2, 3, 4, 5, 6, 7], all(7)).hasLimits).toBe(false));
  it("breaks its line at a stop that does not count", () => {
    expect(unbroken({ inScale: [true, true, false, true] })).toEqual([[0, 1], [3]]);
  });
  it("ends with this stop, later ones left out", () => {
    const stops = [stop("c", "3"), stop("a", "1"), stop("b", "2")];

    expect(upTo(stops, stop("b", "2"), 30).map((s) => s.id)).toEqual(["a", "b"]);
    expect(upTo(stops, stop("c", "3"), 2).map((s) => s.id)).toEqual(["b", "c"]);
  });
});

describe("target plot", () => {
  it("gives the tolerance 5/6 of the plot", () =>
    expect(toleranceScale(stop("a", "1"))).toEqual({ half: 30, step: 10 }));
  it("widens for a stop far outside", () =>
    expect(toleranceScale(stop("a", "1", { dx_m: 0.05 })).half).toBeCloseTo(60));
  it("draws the heading a hundred times larger when the wedge allows", () => {
    expect(headingFactor(stop("a", "1"))).toBe(100);
    expect(headingFactor(stop("a", "1", { tolerance: { ...tolerance, dheading_rad: 0.02 } }))).toBe(10);
  });
  it.each([
    [10, 10],
    [9, 5],
    [0.34, 0.2],
    [0.6 / 3, 0.2],
    [120, 100],
  ])("a step near %s is %s", (about, step) => expect(niceStep(about)).toBeCloseTo(step, 12));
});

describe("history", () => {
  it("has each stop once, newest first", () => {
    expect(mergeStops([stop("b", "2")], [stop("a", "1"), stop("b", "2")]).map((s) => s.id)).toEqual([
      "b",
      "a",
    ]);
  });
  it.each([
    [{}, true],
    [{ vehicle: "TP-02" }, false],
    [{ station: 7 }, true],
    [{ station: 0 }, false],
  ])("filter %o", (filter, kept) => expect(matches(stop("a", "1"), filter)).toBe(kept));
});

describe("trend scale", () => {
  const flat = (v: number) =>
    series(
      Array.from({ length: 8 }, () => v),
      all(8),
    );
  const wild = series([10, -10, 10, -10, 10, -10, 10, -10], all(8));

  it("keeps every stop that counts inside the row", () => {
    expect(trendReach(flat(1.4), 1)).toBeCloseTo(1.48);
    expect(trendReach(flat(0.1), 1)).toBe(1.12);
  });
  it("shows the control limits, but not so far out that the row goes flat", () => {
    const drawn = (data: Series, limit: number) => limitsWithin(data, limit * trendReach(data, limit));

    expect(drawn(wild, 30)).toHaveLength(2);
    expect(trendReach(wild, 10)).toBe(3);
    expect(drawn(wild, 10)).toEqual([]);
    expect(drawn(series([1, 2], all(2)), 10)).toEqual([]);
  });
  it.each([
    [25, 0],
    [12.5, 1],
    [0.5, 1],
    [0.2, 1],
    [0.05, 2],
    [0.0012, 3],
  ])("a limit of %s is printed with %s decimals", (limit, decimals) =>
    expect(limitDecimals(limit)).toBe(decimals),
  );
});

describe("older pages", () => {
  it.each([
    ["c", 3, false],
    ["c", 4, true],
    ["a", 2, true],
    ["a", 1, false],
  ])("stop %s with %s wanted asks for more: %s", (id, count, asks) => {
    const stops = [stop("c", "3"), stop("b", "2"), stop("a", "1")];

    expect(
      wantsOlder(
        stops,
        stops.find((s) => s.id === id)!,
        count,
      ),
    ).toBe(asks);
  });
});

describe("a stop far outside", () => {
  it.each([
    [0.099, 100],
    [-0.6, 100],
    [-1.38, 10],
    [7, 1],
  ])("of %s degrees has its heading drawn times %s", (deg, factor) =>
    expect(headingFactor(stop("a", "1", { dheading_rad: (deg * Math.PI) / 180 }))).toBe(factor),
  );
  it.each([-50, 0, 31, 40])("at %s mm keeps its ray within the plot of 60 mm", (y) =>
    expect(y + rayLength(y, 60)).toBeLessThanOrEqual(60),
  );
  it("near the label's corner sends the label to the other one", () => {
    expect(toleranceLabelSide({ x: 51, y: 31 }, 61)).toBe(-1);
    expect(toleranceLabelSide({ x: -3, y: 0 }, 30)).toBe(1);
  });
});

describe("the list of measured and unmeasured stops", () => {
  const at = (minute: number) => `2026-11-25T08:${String(minute).padStart(2, "0")}:00Z`;
  const record = (minute: number, inside = true) => stop(`r${minute}`, at(minute), { inside });
  const event = (minute: number) => ({ seq: minute, at: at(minute) }) as FleetEvent;
  const minutes = (list: ReturnType<typeof listedStops>) => list.map((s) => Number(s.at.slice(14, 16)));

  it("has both by time, newest first", () => {
    const list = listedStops(
      { items: [record(9), record(5)], more: false },
      { items: [event(7)], more: false },
    );
    expect(minutes(list)).toEqual([9, 7, 5]);
  });
  it.each([
    ["older records may be missing", true, false, [9, 7, 5]],
    ["older unmeasured ones may be missing", false, true, [9, 7]],
    ["nothing is missing", false, false, [9, 7, 5, 3]],
  ])("shows nothing beyond the end of a page: %s", (_, moreRecords, moreEvents, shown) => {
    const list = listedStops(
      { items: [record(9), record(5)], more: moreRecords },
      { items: moreEvents ? [event(7)] : [event(7), event(3)], more: moreEvents },
    );
    expect(minutes(list)).toEqual(shown);
  });
  it("knows how each came out", () => {
    const list = listedStops(
      { items: [record(9), record(5, false)], more: false },
      { items: [event(7)], more: false },
    );
    expect(list.map(resultOf)).toEqual([undefined, "unmeasured", "outside"]);
  });
});
