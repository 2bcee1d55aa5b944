import { describe, expect, it } from "vitest";
import type { Plant } from "@/shared/api/types";
import { emptyPlace, nudged, placePressed, standsAt, type PlaceDraft } from "./placeTool";

const deg = Math.PI / 180;
const pose = (x_m: number, y_m: number, degrees: number) => ({ x_m, y_m, heading_rad: degrees * deg });
const plant = { stations: [{ id: "st07", number: 7, pose: pose(95, 20, 90) }] } as unknown as Plant;
const point = (x_m: number, y_m: number) => ({ kind: "point", point: { x_m, y_m }, reach_m: 1 }) as const;
const press = (draft: PlaceDraft, ...picks: Parameters<typeof placePressed>[1][]) =>
  picks.reduce((d, p) => placePressed(d, p, plant, 0.5), draft);

describe("a press on the map", () => {
  it("takes a station as a whole pose", () => {
    const draft = press(emptyPlace, { kind: "station", id: "st07", number: 7 });
    expect(draft).toMatchObject({ pose: plant.stations[0]?.pose, station: 7, next: "place" });
  });
  it("takes bare floor as the place, with the heading it had, then as where the front points", () => {
    const place = press(emptyPlace, point(10, 5));
    expect(place.pose?.heading_rad).toBeCloseTo(0.5, 4);
    expect(place.next).toBe("front");
    const both = press(place, point(10, 9));
    expect(both).toMatchObject({ pose: { x_m: 10, y_m: 5 }, next: "place" });
    expect(both.pose?.heading_rad).toBeCloseTo(Math.PI / 2, 9);
  });
  it("does not take a vehicle for a place", () => {
    expect(press(emptyPlace, { kind: "vehicle", id: "TP-01" })).toEqual(emptyPlace);
  });
});

describe("fine steps", () => {
  const at: PlaceDraft = { ...emptyPlace, pose: pose(95, 20, 90), station: 7 };
  it.each([
    ["east", 1, 1, pose(95.1, 20, 90)],
    ["north", -1, 1, pose(95, 19.9, 90)],
    ["heading", 1, 1, pose(95, 20, 91)],
    ["east", -1, 0, pose(94, 20, 90)],
    ["north", 1, 2, pose(95, 20.01, 90)],
    ["heading", -1, 2, pose(95, 20, 89.9)],
  ] as const)("%s %i at step %i", (axis, sign, step, expected) => {
    const moved = nudged({ ...at, step }, axis, sign, undefined);
    expect(moved.station).toBeUndefined();
    expect(moved.pose?.x_m).toBe(expected.x_m);
    expect(moved.pose?.y_m).toBe(expected.y_m);
    expect(moved.pose?.heading_rad).toBeCloseTo(expected.heading_rad, 9);
  });
  it("come back exactly where they began, and stay inside a turn", () => {
    let draft = at;
    for (let i = 0; i < 10; i++) draft = nudged(draft, "east", 1, undefined);
    for (let i = 0; i < 10; i++) draft = nudged(draft, "east", -1, undefined);
    for (let i = 0; i < 360; i++) draft = nudged(draft, "heading", 1, undefined);
    expect(draft.pose?.x_m).toBe(95);
    expect(draft.pose?.heading_rad).toBeCloseTo(Math.PI / 2, 9);
  });
  it("go on from where the vehicle was believed to be", () => {
    expect(nudged(emptyPlace, "east", 1, pose(3, 4, 0)).pose).toMatchObject({ x_m: 3.1, y_m: 4 });
    expect(nudged(emptyPlace, "east", 1, undefined)).toEqual(emptyPlace);
  });
});

it.each([
  [pose(95.02, 20, 90.5), true],
  [pose(95.2, 20, 90), false],
  [pose(95, 20, 92), false],
  [pose(95, 20, 450), true],
  [undefined, false],
])("knows by %j whether the vehicle took it", (reported, taken) =>
  expect(standsAt(reported, pose(95, 20, 90))).toBe(taken),
);
