import { describe, expect, it } from "vitest";
import type { Plant, Vehicle } from "@/shared/api/types";
import { emptyTour, faults, toRequest, tour, type Tour, type TourEvent } from "./tour";
import { arrivals, isSame, type Scene, type Transfer } from "./tourActions";

const station = (number: number, over: object = {}) => ({
  id: `s${number}`,
  number,
  parks: false,
  vehicle_types: [],
  ...over,
});
const plant = {
  vehicle_types: [
    { id: "platform", brackets: [], parking: { feet: [] } },
    { id: "mover", brackets: [] },
  ],
  vehicles: [
    { id: "TP-01", type: "platform" },
    { id: "MV-01", type: "mover" },
  ],
  stations: [
    station(1, { support: { height_m: 0.02 }, vehicle_types: ["platform"] }),
    station(2, { vehicle_types: ["platform"] }),
    station(3),
    station(6, { parks: true, vehicle_types: ["platform"] }),
    station(7, { support: { height_m: 0.12 }, vehicle_types: ["platform"] }),
    station(8, { parks: true }),
    station(9, { parks: true, vehicle_types: ["mover"] }),
  ],
} as unknown as Plant;
const kDown = 0.12;
const platform = (over: object = {}) =>
  ({ id: "TP-01", parking_feet: [{ name: "front left", extension_m: 0 }], ...over }) as unknown as Vehicle;
const scene = (over: Partial<Scene> = {}): Scene => ({
  plant,
  vehicle: undefined,
  there: new Map([["s1", "A-101"]]),
  ...over,
});
const run = (state: Tour, ...events: TourEvent[]) => events.reduce(tour, state);
const to = (...stations: number[]) =>
  run(
    emptyTour(),
    { kind: "station", id: 1, station: String(stations[0]) },
    ...stations.slice(1).map((n): TourEvent => ({ kind: "add", station: String(n) })),
  );
const feet = (id: number, on = true): TourEvent => ({ kind: "feet", id, feet: on });
const pick = (id: number, load: string): TourEvent => ({
  kind: "transfer",
  id,
  transfer: { type: "pick", load },
});
const drop = (id: number): TourEvent => ({ kind: "transfer", id, transfer: { type: "drop" } });
const told = (transfers: readonly Transfer[]) =>
  transfers.map((one) => (one.type === "pick" ? one.load : "down")).join(" ");

describe("the feet at a station of a tour", () => {
  const at = (number: number, vehicle = "") => arrivals({ ...to(number), vehicle }, scene())[0]?.feet;
  it.each([
    [2, "TP-01", false],
    [6, "TP-01", true],
    [3, "MV-01", undefined],
    [8, "MV-01", undefined],
    [6, "", true],
    [8, "", false],
    [9, "", undefined],
    [99, "", undefined],
  ])("%i with %j: %s", (number, vehicle, is) => expect(at(number, vehicle)).toBe(is));
  it("are as a person wants them", () => {
    expect(arrivals(run(to(2, 6), feet(1), feet(2, false)), scene()).map((a) => a.feet)).toEqual([
      true,
      false,
    ]);
  });
});

describe("loads along a tour", () => {
  const offered = (state: Tour, over: Partial<Scene> = {}) =>
    arrivals(state, scene(over)).map((a) => told(a.transfers));
  it("are offered where a support is, as they are there by then", () => {
    expect(offered(to(2, 1, 7))).toEqual(["", "A-101 down", "down"]);
    expect(offered(run(to(1, 7, 1, 7), pick(1, "A-101"), drop(2)))).toEqual([
      "A-101 down",
      "down",
      "down",
      "A-101 down",
    ]);
  });
  it("that the chosen vehicle brings along are known, those of any are not", () => {
    const state = run(to(7, 1, 7), drop(1));
    expect(offered(state, { vehicle: platform({ load: "A-102" }) })).toEqual([
      "down",
      "A-101 down",
      "A-102 down",
    ]);
    expect(offered(state)).toEqual(["down", "A-101 down", "down"]);
  });
  it("that were chosen stay to be seen, though they are elsewhere by then", () => {
    expect(offered(run(to(1), pick(1, "A-109")))).toEqual(["A-109 A-101 down"]);
  });
  it("are taken over or set down, not both", () => {
    const [step] = run(to(1), pick(1, "A-101"), drop(1)).steps;
    expect(step?.transfer).toEqual({ type: "drop" });
    expect(isSame({ type: "drop" }, { type: "pick", load: "A-101" })).toBe(false);
  });
});

it("what was chosen for a station is dropped with it, and kept when its row moves", () => {
  const state = run(to(1, 2), pick(1, "A-101"), feet(1));
  expect(run(state, { kind: "move", id: 1, by: 1 }).steps[1]).toMatchObject({
    feet: true,
    transfer: { load: "A-101" },
  });
  expect(run(state, { kind: "station", id: 1, station: "7" }).steps[0]).toEqual({
    id: 1,
    station: "7",
    mode: "auto",
  });
});

describe("the order of a tour", () => {
  const asked = (state: Tour, over: Partial<Scene> = {}) =>
    toRequest(state, scene(over)).steps.map(({ before, after }) => ({
      before: before?.map((a) => a.type),
      after: after?.map((a) => a.type),
    }));
  const plain = { before: undefined, after: [] };
  it("says that nothing is done where nothing is", () => expect(asked(to(2, 1))).toEqual([plain, plain]));
  it("stands on its feet once the load is moved, and is raised before it goes on", () => {
    expect(asked(run(to(1, 2, 3), pick(1, "A-101"), feet(1)))).toEqual([
      { before: undefined, after: ["pick", "lowerParking"] },
      { before: ["raiseParking"], after: [] },
      plain,
    ]);
  });
  it("names the load", () => {
    expect(toRequest(run(to(1), pick(1, "A-101")), scene()).steps[0]?.after).toEqual([
      { type: "pick", parameters: { load: "A-101" } },
    ]);
    expect(toRequest(run(to(7), drop(1)), scene()).steps[0]?.after).toEqual([{ type: "drop" }]);
  });
  it("does at a station that parks what it is for, unless a person does not want it", () => {
    expect(asked(to(6))).toEqual([{ before: undefined, after: ["lowerParking"] }]);
    expect(asked(run(to(6), feet(1, false)))).toEqual([plain]);
  });
  it("raises the feet on which the chosen vehicle stands now", () => {
    const down = platform({ parking_feet: [{ name: "front left", extension_m: kDown }] });
    expect(asked(to(2, 3), { vehicle: down })).toEqual([{ before: ["raiseParking"], after: [] }, plain]);
    expect(asked(to(2), { vehicle: platform() })).toEqual([plain]);
  });
  it("does nothing where nothing can be done any more", () => {
    expect(asked({ ...run(to(3), feet(1)), vehicle: "MV-01" })).toEqual([plain]);
    expect(asked(run(to(2), drop(1)))).toEqual([plain]);
  });
});

describe("the brackets at a station of a tour", () => {
  const lifting = (stroke_m: number, ...names: string[]) => ({
    brackets: names.map((name) => ({ name })),
    bracket_lift: { stroke_m },
  });
  const [platforms, movers] = plant.vehicle_types;
  const withLifts = {
    ...plant,
    vehicle_types: [
      { ...platforms, ...lifting(0.3, "front left", "front right") },
      { ...movers, brackets: [] },
    ],
  } as unknown as Plant;
  const at = (number: number, vehicle: string, draft?: { bracket: string; text: string }) => {
    const state = run({ ...to(number), vehicle }, { kind: "brackets", id: 1, brackets: draft });
    return { state, arrival: arrivals(state, scene({ plant: withLifts }))[0] };
  };
  it.each([
    [2, "TP-01", { stroke_m: 0.3, names: ["front left", "front right"] }],
    [3, "", { stroke_m: 0.3, names: ["front left", "front right"] }],
    [3, "MV-01", undefined],
    [9, "", undefined],
  ])("station %d, vehicle %j: %o", (number, vehicle, lift) =>
    expect(at(number, vehicle).arrival?.lift).toEqual(lift),
  );
  it("go to their height before the load is moved and the feet are lowered", () => {
    const { state } = at(7, "TP-01", { bracket: "all", text: "160" });
    const body = toRequest(run(state, drop(1), feet(1)), scene({ plant: withLifts }));
    expect(body.steps[0]?.after).toEqual([
      { type: "setBracketHeight", parameters: { bracket: "all", height_m: 0.16 } },
      { type: "drop" },
      { type: "lowerParking" },
    ]);
  });
  it.each([
    ["", "brackets_empty"],
    ["301", "brackets_bad_height"],
  ])("to %j mm are a fault of their row, and are not sent", (text, kind) => {
    const { state } = at(2, "TP-01", { bracket: "all", text });
    expect(faults(state, withLifts)).toEqual([{ kind, id: 1 }]);
    expect(toRequest(state, scene({ plant: withLifts })).steps[0]?.after).toEqual([]);
  });
  it("are not meant for another station", () => {
    const { state } = at(2, "TP-01", { bracket: "all", text: "100" });
    const other = run(state, { kind: "station", id: 1, station: "3" });
    expect(other.steps[0]?.brackets).toBeUndefined();
  });
  it("stay where they are where only a vehicle without any may come", () => {
    const { state } = at(3, "MV-01", { bracket: "all", text: "100" });
    expect(faults(state, withLifts)).toEqual([]);
    expect(toRequest(state, scene({ plant: withLifts })).steps[0]?.after).toEqual([]);
  });
});
