import { describe, expect, it } from "vitest";
import type { Lane } from "@/shared/map";
import { emptyFloor, laneAt, outlineOf, pressed, sizeOf, toClosure, type FloorDraft } from "./floorTool";

const lane = (ax: number, ay: number, bx: number, by: number, ...edges: string[]): Lane => ({
  ax,
  ay,
  bx,
  by,
  edges,
  big: false,
  oneWay: edges.length === 1,
});
const lanes = [lane(0, 0, 20, 0, "a.b"), lane(0, 10, 20, 10, "c.d", "d.c")];
const at = (x_m: number, y_m: number) => ({ x_m, y_m });
const press = (draft: FloorDraft, ...points: [number, number][]) =>
  points.reduce((d, [x, y]) => pressed(d, lanes, at(x, y), 1), draft);

it.each([
  [at(10, 0.5), "a.b"],
  [at(10, 9.2), "c.d"],
  [at(10, 5), undefined],
])("finds the lane under %j", (point, edge) => expect(laneAt(lanes, point, 1)?.edges[0]).toBe(edge));

describe("a press on the map", () => {
  it("takes a lane with both directions, and gives it back", () => {
    const one = press(emptyFloor, [5, 10]);
    expect(one.edges).toEqual(["c.d", "d.c"]);
    expect(press(one, [5, 0]).edges).toEqual(["c.d", "d.c", "a.b"]);
    expect(press(one, [15, 10]).edges).toEqual([]);
  });
  it("beside all lanes begins an area, whose second corner may lie on one", () => {
    const area = press(emptyFloor, [4, 5], [8, 0]);
    expect(area).toMatchObject({ how: "area", edges: [], area: [at(4, 5), at(8, 0)] });
  });
  it("does not throw chosen lanes away", () => {
    const one = press(emptyFloor, [5, 0]);
    expect(press(one, [5, 5])).toEqual(one);
  });
  it("waits for a corner that spans an area", () => {
    const first = press(emptyFloor, [4, 5]);
    expect(press(first, [4.1, 7])).toEqual(first);
  });
  it("after a whole area begins the next", () => {
    const next = press(emptyFloor, [4, 5], [8, 7], [12, 4]);
    expect(next).toMatchObject({ corner: at(12, 4), area: undefined });
  });
});

it("gives the corners counter-clockwise, whichever two were pressed", () => {
  const ring = [at(1, 2), at(5, 2), at(5, 9), at(1, 9)];
  expect(outlineOf([at(5, 2), at(1, 9)])).toEqual(ring);
  expect(outlineOf([at(1, 2), at(5, 9)])).toEqual(ring);
});

it("asks for nothing while nothing is chosen", () => {
  expect(toClosure(emptyFloor, "x", "hall")).toBeUndefined();
  expect(toClosure(press(emptyFloor, [4, 5]), "x", "hall")).toBeUndefined();
  expect(toClosure(press(emptyFloor, [5, 0]), "x", "hall")).toEqual({ name: "x", edges: ["a.b"] });
  expect(toClosure(press(emptyFloor, [4, 5], [6, 7]), "x", "hall")).toMatchObject({
    name: "x",
    hall: "hall",
  });
});

it("counts a pair of edges as one lane", () => {
  expect(sizeOf({ edges: ["c.d", "d.c", "a.b"] }, lanes)).toEqual({ kind: "lanes", count: 2 });
  expect(sizeOf({ edges: [], outline: outlineOf([at(0, 0), at(4, 3)]) }, lanes)).toEqual({
    kind: "area",
    x_m: 4,
    y_m: 3,
  });
});
