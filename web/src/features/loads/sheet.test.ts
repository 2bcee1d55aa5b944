import { describe, expect, it } from "vitest";
import type { Load, VehicleType } from "@/shared/api/types";
import { scaleOf, sheetOf, sizeOf } from "./sheet";

const ring = (length: number, width: number) =>
  [-1, 1].flatMap((x) => [-1, 1].map((y) => ({ x_m: (x * length) / 2, y_m: (y * width) / 2 })));
const load: Load = {
  id: "A-1",
  name: "A-1",
  kind: "airframe",
  mass_kg: 100,
  centre: { x_m: 0.2, y_m: -0.1 },
  carriers: [],
  since: "",
};
const type = {
  footprint: ring(10, 2),
  load_footprint: ring(14, 8),
  brackets: [3, -1].map((x_m) => ({ name: `at ${x_m}`, position: { x_m, y_m: 0 } })),
} as unknown as VehicleType;

describe("the sheet of a load", () => {
  it("has the centre of gravity from the middle of the brackets", () =>
    expect(sheetOf(load, type).centre).toEqual({ x_m: 1.2, y_m: -0.1 }));
  it("draws its own outline", () => {
    const sheet = sheetOf({ ...load, outline: ring(12, 3) }, type);
    expect([sheet.usual, sheet.outline.length]).toEqual([false, 4]);
    expect(sheet.box.width).toBeGreaterThan(12);
  });
  it("without one draws what the type usually carries", () => {
    const sheet = sheetOf(load, type);
    expect(sheet.usual).toBe(true);
    expect(sheet.box.width).toBeGreaterThan(14);
  });
  it("has room where nobody may carry it and nothing is known of it", () => {
    const { box } = sheetOf(load, undefined);
    expect(box.width).toBeGreaterThan(0);
    expect(Number.isFinite(box.height)).toBe(true);
  });
});

it.each([
  [14, 2],
  [2.4, 0.5],
  [40, 10],
  [0.3, 0.1],
])("of %s m of load has a line of %s m", (length, line) => expect(scaleOf(length)).toBe(line));

it("says length and width of an outline, and nothing without one", () => {
  expect(sizeOf(ring(12.345, 3))).toEqual({ length: "12.35", width: "3.00" });
  expect(sizeOf([])).toBeUndefined();
});
