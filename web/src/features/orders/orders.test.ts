import { describe, expect, it } from "vitest";
import type { JobOrder, JobState, Plant } from "@/shared/api/types";
import { actionsOf, mergeOrders } from "./orderLook";
import { emptyTour, faults, kMaxSteps, toRequest, tour, type Tour, type TourEvent } from "./tour";

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
const plant = { stations: [{ number: 1 }, { number: 2 }, { number: 3 }] } as Plant;
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
  it("takes digits only and a priority inside the contract", () => {
    const state = run(
      emptyTour(),
      { kind: "station", id: 1, station: "a1b23456" },
      { kind: "priority", priority: 900 },
    );

    expect(state).toMatchObject({ priority: 100, steps: [{ station: "1234" }] });
  });
  it("leaves the vehicle out when any may drive", () => {
    const body = toRequest(run(numbers("1", "2"), { kind: "mode", id: 2, mode: "linear" }));

    expect(body).toEqual({
      priority: 0,
      steps: [
        { station: 1, motion_mode: "auto" },
        { station: 2, motion_mode: "linear" },
      ],
    });
    expect(toRequest({ ...numbers("1"), vehicle: "TP-01" }).vehicle).toBe("TP-01");
  });
});
