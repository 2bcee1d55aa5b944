import { describe, expect, it } from "vitest";
import type { Plant, Ring, Vehicle } from "@/shared/api/types";
import { clearanceLine, nearestBody } from "./clearance";
import { passes } from "./otherWays";

const box = (x0: number, y0: number, x1: number, y1: number): Ring => [
  { x_m: x0, y_m: y0 },
  { x_m: x1, y_m: y0 },
  { x_m: x1, y_m: y1 },
  { x_m: x0, y_m: y1 },
];

describe("clearanceLine", () => {
  it.each([
    ["beside each other", box(0, 0, 4, 2), box(4.63, -5, 9, 9), 0.63],
    ["corner to corner", box(0, 0, 1, 1), box(4, 5, 6, 6), 5],
    ["around it, as walls are", box(1, 3, 4, 4), box(0, 0, 10, 10), 1],
  ])("%s", (_, swept, body, length) => {
    const line = clearanceLine([swept], [body])!;

    expect(Math.hypot(line.to.x_m - line.from.x_m, line.to.y_m - line.from.y_m)).toBeCloseTo(length, 9);
  });
  it("is not drawn where they touch or nothing is known", () => {
    expect(clearanceLine([box(0, 0, 1, 1)], [box(1, 0, 2, 1)])).toBeUndefined();
    expect(clearanceLine([], [box(1, 0, 2, 1)])).toBeUndefined();
  });
});

describe("nearestBody", () => {
  const plant = {
    halls: [{ id: "h", outline: box(0, 0, 50, 50) }],
    areas: [{ id: "rack", outline: box(1, 1, 2, 2) }],
    vehicle_types: [{ id: "t", footprint: box(-1, -1, 1, 1), load_footprint: box(-2, -2, 2, 2) }],
  } as unknown as Plant;
  const other = (over: Partial<Vehicle>) =>
    [
      { id: "V", type: "t", load_kg: 0, load_name: "", pose: { x_m: 10, y_m: 0, heading_rad: 0 }, ...over },
    ] as Vehicle[];
  it.each<[string, string | undefined, Vehicle[], number | undefined]>([
    ["a wall", "wall", [], 1],
    ["a rack", "rack", [], 1],
    ["a vehicle", "V", other({}), 1],
    ["a vehicle with its load", "V", other({ load_kg: 100 }), 2],
    [
      "a vehicle that nobody knows the place of",
      "V",
      [{ ...other({})[0]!, pose: undefined } as unknown as Vehicle],
      undefined,
    ],
    ["what only the map knows", "map", [], undefined],
    ["nothing", undefined, [], undefined],
  ])("%s", (_, name, vehicles, rings) => expect(nearestBody(name, vehicles, plant, "h")?.length).toBe(rings));
  it("puts a vehicle where it stands", () =>
    expect(nearestBody("V", other({}), plant, "h")?.[0]?.[0]).toEqual({ x_m: 9, y_m: -1 }));
});

describe("another way", () => {
  it("is named by the stations that it leads past, not by the plan's inner names", () => {
    const plant = {
      stations: [
        { node: "st26", number: 26 },
        { node: "st25", number: 25 },
        { node: "a", number: 1 },
      ],
    } as Plant;

    expect(passes({ route: ["a", "st26", "c-north-4", "st25", "b"] }, plant)).toEqual([26, 25]);
    expect(passes({ route: ["a", "b"] }, plant)).toEqual([]);
  });
});
