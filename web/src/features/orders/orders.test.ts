import { describe, expect, it } from "vitest";
import type { DryRun, JobOrder, JobState, Plant } from "@/shared/api/types";
import { actionsOf, foundOrders, mergeOrders, tookS } from "./orderLook";
import {
  chosenOf,
  emptyTour,
  faults,
  kMaxSteps,
  tourTime,
  toRequest,
  tour,
  type Tour,
  type TourEvent,
} from "./tour";
import type { Scene } from "./tourActions";

const order = (id: string, number: number, state: JobState, over: Partial<JobOrder> = {}): JobOrder =>
  ({
    id,
    number,
    state,
    revision: 1,
    pause_requested: false,
    cancel_requested: false,
    steps: [],
    ...over,
  }) as unknown as JobOrder;
const plant = { vehicles: [], stations: [{ number: 1 }, { number: 2 }, { number: 3 }] } as unknown as Plant;
const nowhere: Scene = { plant: undefined, vehicle: undefined, there: new Map() };
const run = (state: Tour, ...events: TourEvent[]) => events.reduce(tour, state);
const numbers = (...n: string[]) =>
  run(
    emptyTour(),
    { kind: "station", id: 1, station: n[0] ?? "" },
    ...n.slice(1).map((station): TourEvent => ({ kind: "add", station })),
  );

describe("orders", () => {
  it("shows what needs a person first, then what runs, then what waits, then the newest", () => {
    const sorted = mergeOrders(
      [order("a", 1, "Ended"), order("b", 2, "Running"), order("c", 3, "Interrupted")],
      [order("d", 9, "Aborted"), order("e", 4, "AllowedToStart")],
    );

    expect(sorted.map((o) => o.id)).toEqual(["c", "b", "e", "d", "a"]);
  });
  it("keeps the newest revision of an order", () => {
    const merged = mergeOrders(
      [order("a", 1, "Running", { revision: 2 })],
      [order("a", 1, "Ended", { revision: 3 })],
    );

    expect(merged.map((o) => o.state)).toEqual(["Ended"]);
  });
  it("does not list what was taken out, though an older page still has it", () => {
    const gone = order("a", 1, "Ended", { revision: 3, removed: true });
    expect(mergeOrders([gone], [order("a", 1, "Ended", { revision: 2 })])).toEqual([]);
  });
  it.each<[JobState, Partial<JobOrder>, string]>([
    ["Running", {}, "pause cancel"],
    ["AllowedToStart", {}, "pause cancel"],
    ["Interrupted", {}, "resume cancel"],
    ["NotAllowedToStart", {}, "resume cancel"],
    ["Running", { pause_requested: true }, "pause cancel"],
    ["Running", { cancel_requested: true }, "cancel"],
    ["Interrupted", { reason: { code: "paused_by_person", params: {} } }, "pause resume cancel"],
    ["Ended", {}, ""],
    ["Aborted", {}, ""],
  ])("%s %o allows: %s", (state, over, what) => {
    const can = actionsOf(order("a", 1, state, over));

    expect(
      Object.entries(can)
        .filter(([, on]) => on)
        .map(([name]) => name)
        .join(" "),
    ).toBe(what);
  });
});

describe("tour", () => {
  it("keeps rows through moves and removals", () => {
    const state = run(numbers("1", "2", "3"), { kind: "move", id: 3, by: -1 }, { kind: "remove", id: 1 });

    expect(state.steps.map((s) => s.station)).toEqual(["3", "2"]);
  });
  it("cannot lose its last row nor pass the contract's limit", () => {
    const full = run(emptyTour(), ...Array.from({ length: 200 }, (): TourEvent => ({ kind: "add" })));

    expect(full.steps).toHaveLength(kMaxSteps);
    expect(run(emptyTour(), { kind: "remove", id: 1 }).steps).toHaveLength(1);
    expect(run(numbers("1", "2"), { kind: "move", id: 1, by: -1 }).steps.map((s) => s.id)).toEqual([1, 2]);
  });
  it("names what is wrong by row", () => {
    expect(faults(numbers("1", "1", "9", ""), plant).map((f) => `${f.id} ${f.kind}`)).toEqual([
      "2 repeated",
      "3 unknown",
      "4 missing",
    ]);
    expect(faults(numbers("1", "2", "1"), plant)).toEqual([]);
  });
  it("refuses a station that is not for the chosen vehicle, before the server does", () => {
    const hall = {
      vehicles: [{ id: "TP-01", type: "platform" }],
      stations: [
        { number: 1, vehicle_types: ["platform"] },
        { number: 15, vehicle_types: ["tracker"] },
        { number: 40, vehicle_types: [] },
      ],
    } as unknown as Plant;
    const kinds = (vehicle: string) =>
      faults({ ...numbers("1", "15", "40"), vehicle }, hall).map((f) => `${f.id} ${f.kind}`);

    expect(kinds("TP-01")).toEqual(["2 wrong_type"]);
    expect(kinds("")).toEqual([]);
  });
  it("adds up the drives, and says nothing while one cannot be driven", () => {
    const option = (mode: string, feasible: boolean, duration_s: number, suggested = false) => ({
      mode,
      feasible,
      duration_s,
      suggested,
    });
    const preview = {
      steps: [
        { options: [option("free", true, 90), option("linear", true, 60, true)] },
        { options: [option("lateral", false, 0), option("free", true, 30, true)] },
      ],
    } as unknown as DryRun;
    const state = numbers("1", "2");

    expect(chosenOf(preview.steps[0]!, "auto")?.mode).toBe("linear");
    expect(tourTime(state, preview)).toBe(90);
    expect(tourTime(run(state, { kind: "mode", id: 1, mode: "free" }), preview)).toBe(120);
    expect(tourTime(run(state, { kind: "mode", id: 2, mode: "lateral" }), preview)).toBeUndefined();
  });
  it("takes digits only and a priority inside the contract", () => {
    const state = run(
      emptyTour(),
      { kind: "station", id: 1, station: "a1b23456" },
      { kind: "priority", priority: 900 },
    );

    expect(state).toMatchObject({ priority: 100, steps: [{ station: "1234" }] });
  });
  it("leaves the vehicle out when any may drive", () => {
    const body = toRequest(run(numbers("1", "2"), { kind: "mode", id: 2, mode: "linear" }), nowhere);

    expect(body).toEqual({
      priority: 0,
      steps: [
        { station: 1, motion_mode: "auto", after: [] },
        { station: 2, motion_mode: "linear", after: [] },
      ],
    });
    expect(toRequest({ ...numbers("1"), vehicle: "TP-01" }, nowhere).vehicle).toBe("TP-01");
  });
});

it.each([
  ["jo-2", false, ["b"]],
  ["tp-01", false, ["a"]],
  ["7", false, ["b"]],
  ["mes", false, ["c"]],
  ["", true, ["a", "b"]],
  ["nothing", false, []],
])("finds by %j, only open ones: %s", (find, open, ids) => {
  const all = [
    order("a", 1, "Running", { name: "JO-1", vehicle: "TP-01" }),
    order("b", 2, "AllowedToStart", {
      name: "JO-2",
      vehicle: "",
      wanted_vehicle: "",
      steps: [{ number: 7 }] as JobOrder["steps"],
    }),
    order("c", 3, "Ended", { name: "JO-3", vehicle: "MV-01", client_order_id: "MES-44" }),
  ];
  expect(foundOrders(all, find, open).map((o) => o.id)).toEqual(ids);
});

it.each<[string, Partial<JobOrder>, number | undefined]>([
  ["took", { started_at: "2026-11-25T07:00:00Z", ended_at: "2026-11-25T07:01:30Z" }, 90],
  ["never began", { ended_at: "2026-11-25T07:01:30Z" }, undefined],
  ["runs", { started_at: "2026-11-25T07:00:00Z" }, undefined],
])("an order that %s", (_, over, seconds) => expect(tookS(order("a", 1, "Ended", over))).toBe(seconds));
