import { describe, expect, it } from "vitest";
import type { LiveStation } from "@/shared/live";
import { placeOf, placesFor, told } from "./places";

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

  it("tells nobody's name for a place that it has left", () => {
    const answer = { vehicle: "TP-01", by: "ann" };
    expect(told({ vehicle: "TP-01" }, answer)?.by).toBe("ann");
    expect(told({ station: 7 }, answer)).toBeUndefined();
    expect(told({}, answer)).toBeUndefined();
  });
});

describe("where a person may say that it is", () => {
  const aircraft = { carriers: ["platform"] };
  const vehicles = [
    { id: "TP-01", type: "platform", load: "A-1" },
    { id: "TP-02", type: "platform" },
    { id: "TP-03", type: "platform", load: "A-3" },
    { id: "OM-01", type: "omni" },
  ];
  const stations = [station(0), station(5, undefined, false), station(7, "A-2")];

  it("is what is free for it, and out of the plant", () =>
    expect(placesFor(aircraft, { vehicle: "TP-01" }, vehicles, stations)).toEqual({
      vehicles: ["TP-02"],
      stations: [0],
      nowhere: true,
    }));
  it("is not where it is", () => expect(placesFor(aircraft, {}, vehicles, stations).nowhere).toBe(false));
});
