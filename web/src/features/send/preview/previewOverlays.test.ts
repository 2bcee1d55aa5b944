import { describe, expect, it } from "vitest";
import type { ModeOption, Plant, Station, Vehicle } from "@/shared/api/types";
import { areasOf, fits, previewOf } from "./previewOverlays";

const at = (x_m: number, y_m: number) => ({ x_m, y_m });
const pose = (x_m: number, y_m: number) => ({ x_m, y_m, heading_rad: 0 });
const square = (r: number) => [at(-r, -r), at(r, -r), at(r, r), at(-r, r)];
const station = (id: string, vehicle_types: string[], x = 0) =>
  ({ id, number: 1, vehicle_types, pose: pose(x, 0) }) as unknown as Station;
const plant = {
  vehicle_types: [{ id: "platform", footprint: square(2), load_footprint: square(6) }],
  stations: [station("a", ["platform"], 10), station("b", ["mobile"]), station("c", [])],
} as unknown as Plant;
const vehicle = { id: "TP-01", type: "platform", load_kg: 0, load_name: "", pose: pose(0, 0) } as Vehicle;
const option = (mode: ModeOption["mode"], reach: number): ModeOption => ({
  mode,
  feasible: true,
  suggested: false,
  length_m: 10,
  swept: [[at(0, 0), at(reach, 0), at(reach, 3)]],
  segments: [
    { kind: "straight", start: pose(0, 0), end: pose(10, 0), turn_rad: 0, length_m: 10, duration_s: 9 },
  ] as unknown as NonNullable<ModeOption["segments"]>,
});
const words = { metres: (m: number) => `${m} m`, degrees: (r: number) => `${r}` };
const input = {
  plant,
  vehicle,
  station: plant.stations[0],
  option: option("linear", 12),
  options: [option("linear", 12), option("free", 30)],
  looked: "free" as const,
  picking: false,
};

it("draws the area of every mode that leads there, the chosen one last and on top", () => {
  expect(areasOf(input).map((a) => [a.mode, a.look, a.rings.length])).toEqual([
    ["free", "looked", 1],
    ["linear", "chosen", 1],
  ]);
});

it.each([
  ["a", true],
  ["b", false],
  ["c", true],
])("a platform may stop at %s: %s", (id, may) =>
  expect(
    fits(
      plant.stations.find((s) => s.id === id)!,
      vehicle,
    ),
  ).toBe(may),
);

describe("the preview", () => {
  it("shows way, end, length, target and what can be chosen", () => {
    const { overlays } = previewOf(input, words);
    expect(overlays).toMatchObject({ target: "a", ghost: { type: "platform", loaded: false } });
    expect(overlays.path).toEqual([at(0, 0), at(10, 0)]);
    expect(overlays.dimension?.text).toBe("10 m");
    expect([...(overlays.choosable ?? [])]).toEqual(["a", "c"]);
  });
  it("shows the codes that the chosen way relies on, and where one is missing", () => {
    const chain = { markers: [], reason: { code: "no_marker_chain", params: { x_m: 4, y_m: 1 } } };
    const option = { ...input.option, marker_chain: chain };
    expect(previewOf({ ...input, option }, words).overlays.chain).toBe(chain);
    const leg = { path: [at(0, 0), at(10, 0)], granted_area: [] } as unknown as NonNullable<Vehicle["leg"]>;
    expect(previewOf({ ...input, option, leg }, words).overlays.chain).toBeUndefined();
    expect(previewOf(input, words).overlays.chain).toBeUndefined();
  });
  it("is about all areas, so that choosing another mode does not move the map", () => {
    const one = previewOf(input, words).about;
    const other = previewOf({ ...input, looked: undefined, option: input.options[1] }, words).about;
    expect(Math.max(...one!.map((p) => p.x_m))).toBe(30);
    expect(Math.max(...other!.map((p) => p.x_m))).toBe(30);
  });
  it("is about the whole hall while a station is looked for", () => {
    expect(previewOf({ ...input, picking: true }, words).about).toBeUndefined();
    expect(previewOf({ ...input, station: undefined }, words).about).toBeUndefined();
  });
  it("gives way to the drive under way", () => {
    const leg = { path: [at(0, 0), at(10, 0)], granted_area: [] } as unknown as NonNullable<Vehicle["leg"]>;
    const { overlays } = previewOf({ ...input, leg }, words);
    expect(overlays).toMatchObject({ areas: [], target: "a" });
    expect(overlays.path).toBeUndefined();
    expect(overlays.choosable).toBeUndefined();
  });
});
