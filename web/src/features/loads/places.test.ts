import { describe, expect, it } from "vitest";
import type { Load, LoadState, VehicleType } from "@/shared/api/types";
import type { LiveStation } from "@/shared/live";
import { carriers, placeOf, placesFor, placesKey, told } from "./places";

const aircraft: Load = { id: "A-1", name: "A-1", kind: "airframe", mass_kg: 18200 };
const bracket = { name: "front left", position: { x_m: 1, y_m: 1 } };
const type = (id: string, brackets: number, max_load_kg: number) =>
  ({ id, brackets: Array.from({ length: brackets }, () => bracket), max_load_kg }) as VehicleType;
const types = [type("platform", 4, 20000), type("small", 4, 500), type("omni", 0, 20000)];
const station = (number: number, holds?: string, support = true) =>
  ({
    number,
    ...(support && { support: { height_m: 0.1 } }),
    state: holds === undefined ? undefined : { load: holds },
  }) as Pick<LiveStation, "number" | "state" | "support">;

describe("where a load is", () => {
  it.each([
    ["on a vehicle", [{ id: "TP-01", load: "A-1" }], [station(7)], { vehicle: "TP-01" }],
    ["at a station", [{ id: "TP-01" }], [station(0, "A-2"), station(7, "A-1")], { station: 7 }],
    ["at the station of number 0", [], [station(0, "A-1")], { station: 0 }],
    ["nowhere", [{ id: "TP-01", load: "A-2" }], [station(7)], {}],
  ])("%s", (_, vehicles, stations, place) => expect(placeOf("A-1", vehicles, stations)).toEqual(place));

  it("is asked again when any of them gets elsewhere", () => {
    expect(placesKey([{ vehicle: "TP-01" }, {}])).not.toBe(placesKey([{ station: 7 }, {}]));
    expect(placesKey([{ station: 0 }])).not.toBe(placesKey([{}]));
  });

  it("tells nobody's name for a place that it has left", () => {
    const state = { vehicle: "TP-01", by: "ann" } as LoadState;
    expect(told({ vehicle: "TP-01" }, state)?.by).toBe("ann");
    expect(told({ station: 7 }, state)).toBeUndefined();
    expect(told({}, undefined)).toBeUndefined();
  });
});

describe("who may carry it", () => {
  it.each<[string, Load, string[]]>([
    ["whoever has brackets and is strong enough", aircraft, ["platform"]],
    ["nobody has weighed it", { ...aircraft, mass_kg: 0 }, ["platform", "small"]],
    ["those that it names", { ...aircraft, vehicle_types: ["omni"] }, ["omni"]],
  ])("%s", (_, load, ids) => expect(carriers(load, types).map(({ id }) => id)).toEqual(ids));
});

describe("where a person may say that it is", () => {
  const vehicles = [
    { id: "TP-01", type: "platform", load: "A-1" },
    { id: "TP-02", type: "platform" },
    { id: "TP-03", type: "platform", load: "A-3" },
    { id: "OM-01", type: "omni" },
  ];
  const stations = [station(0), station(5, undefined, false), station(7, "A-2")];

  it("is what is free for it, and out of the plant", () =>
    expect(placesFor(aircraft, { vehicle: "TP-01" }, types, vehicles, stations)).toEqual({
      vehicles: ["TP-02"],
      stations: [0],
      nowhere: true,
    }));
  it("is not where it is", () =>
    expect(placesFor(aircraft, {}, types, vehicles, stations).nowhere).toBe(false));
});
