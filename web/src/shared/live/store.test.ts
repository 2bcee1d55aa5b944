import fc from "fast-check";
import { describe, expect, it } from "vitest";
import type { JobOrder, StreamFrame, Vehicle } from "@/shared/api/types";
import { emptyState, LiveStore, reduce } from "./store";

const vehicle = (id: string, over: Partial<Vehicle> = {}): Vehicle => ({
  id,
  name: id,
  type: "t",
  link: "live",
  activity: "standing",
  pose_known: true,
  paused: false,
  needs_resume: false,
  integration: "utilise",
  battery_percent: 50,
  operating_mode: "AUTOMATIC",
  errors: [],
  brackets: [],
  wheels: [],
  cameras: [],
  parking_feet: [],
  load_kg: 0,
  load_name: "",
  ...over,
});
const order = (revision: number): JobOrder => ({
  id: "o",
  number: 1,
  name: "JO-1",
  state: "Running",
  priority: 0,
  steps: [],
  current_step: 0,
  vehicle: "",
  wanted_vehicle: "",
  cancel_requested: false,
  pause_requested: false,
  stop_requested: false,
  removed: false,
  created_by: "",
  created_at: "",
  revision,
});
const snapshot = (vehicles: Vehicle[]): StreamFrame => ({
  type: "snapshot",
  server_time: "2026-01-01T00:00:10Z",
  fleet: {
    paused: false,
    last_event_seq: 1,
    vehicles_live: 1,
    vehicles_total: 1,
    needs_resume: [],
    plant_revision: 1,
    server_started_at: "",
  },
  vehicles,
  stations: [],
  job_orders: [order(3)],
  stop_records: [],
});

describe("reduce", () => {
  it("replaces everything with a snapshot", () => {
    const old = reduce(emptyState, snapshot([vehicle("A"), vehicle("B")]), 0);
    const state = reduce(old, snapshot([vehicle("C")]), 0);
    expect([...state.vehicles.keys()]).toEqual(["C"]);
    expect(state.ready).toBe(true);
  });
  it("knows how far the server's clock is ahead", () => {
    expect(reduce(emptyState, snapshot([]), Date.parse("2026-01-01T00:00:00Z")).clockOffsetMs).toBe(10_000);
  });
  it("takes several changes of one frame in order", () => {
    const old = reduce(emptyState, snapshot([vehicle("A")]), 0);
    const state = reduce(
      old,
      {
        type: "changes",
        changes: [
          { type: "vehicle", vehicle: vehicle("A", { activity: "moving" }) },
          { type: "job_order", job_order: order(4) },
          { type: "job_order", job_order: order(2) },
        ],
      },
      0,
    );
    expect(state.vehicles.get("A")?.activity).toBe("moving");
    expect(state.jobOrders.get("o")?.revision).toBe(4);
  });
  it("changes only the part a frame is about", () => {
    const old = reduce(emptyState, snapshot([vehicle("A")]), 0);
    const state = reduce(old, { type: "vehicle", vehicle: vehicle("A", { activity: "moving" }) }, 0);
    expect(state.vehicles.get("A")?.activity).toBe("moving");
    expect(state.jobOrders).toBe(old.jobOrders);
    expect(old.vehicles.get("A")?.activity).toBe("standing");
  });
  it("does not go back to an older revision of an order", () => {
    const old = reduce(emptyState, snapshot([]), 0);
    expect(reduce(old, { type: "job_order", job_order: order(2) }, 0)).toBe(old);
    expect(reduce(old, { type: "job_order", job_order: order(4) }, 0).jobOrders.get("o")?.revision).toBe(4);
  });
});

describe("what is asked for again", () => {
  const event = (type: string) => ({ type: "event", event: { type } }) as unknown as StreamFrame;
  const turns = (frame: StreamFrame) => {
    const { loadsTurn, floorTurn, unmeasuredTurn } = reduce(emptyState, frame, 0);
    return [loadsTurn, floorTurn, unmeasuredTurn];
  };
  it.each<[string, StreamFrame, number[]]>([
    ["loads, when one is registered", event("load.registered"), [1, 0, 0]],
    ["loads, when more is known of one", event("load.changed"), [1, 0, 0]],
    ["loads, when one has left for ever", event("load.retired"), [1, 0, 0]],
    ["loads, when one gets elsewhere", event("load.moved"), [1, 0, 0]],
    ["floor, when some is closed", event("floor.closed"), [0, 1, 0]],
    ["stops, when one goes unmeasured", event("stop.not_measured"), [0, 0, 1]],
    ["everything at a snapshot", snapshot([]), [1, 1, 1]],
    ["nothing at any other event", event("vehicle.lost"), [0, 0, 0]],
    [
      "loads, for each event of several changes",
      { type: "changes", changes: [event("load.registered"), event("load.moved")] } as StreamFrame,
      [2, 0, 0],
    ],
  ])("%s", (_, frame, expected) => expect(turns(frame)).toEqual(expected));
});

describe("LiveStore", () => {
  function held() {
    const queue: (() => void)[] = [];
    const store = new LiveStore(
      (flush) => void queue.push(flush),
      () => 1000,
      () => 0,
    );
    return { store, queue, flush: () => queue.splice(0).forEach((f) => f()) };
  }

  it("tells listeners once per frame, however much came in", () => {
    const { store, queue, flush } = held();
    let calls = 0;
    store.subscribe(() => calls++);
    for (const id of ["A", "B", "C"]) store.apply({ type: "vehicle", vehicle: vehicle(id) });
    expect([queue.length, calls, store.state.vehicles.size]).toEqual([1, 0, 0]);
    flush();
    expect([calls, store.state.vehicles.size]).toEqual([1, 3]);
  });
  it("keeps poses out of the state", () => {
    const { store, flush } = held();
    let calls = 0;
    let poses = 0;
    store.subscribe(() => calls++);
    store.subscribePoses(() => poses++);
    store.apply({ type: "poses", at: "", poses: [["A", 1, 2, 0.5, 0.3, 0.2]] });
    flush();
    expect([calls, poses]).toEqual([0, 1]);
    expect(store.poses.get("A")).toEqual({ x_m: 1, y_m: 2, heading_rad: 0.5, speed_mps: 0.3, heardAt: 800 });
  });
  it("takes poses that came among changes", () => {
    const { store, flush } = held();
    store.apply({
      type: "changes",
      changes: [
        { type: "vehicle", vehicle: vehicle("A") },
        { type: "poses", at: "", poses: [["A", 1, 2, 0.5, 0.3, 0.2]] },
      ],
    });
    flush();
    expect(store.poses.get("A")?.x_m).toBe(1);
    expect(store.state.vehicles.has("A")).toBe(true);
  });
  it("survives any pose row", () => {
    fc.assert(
      fc.property(fc.array(fc.array(fc.anything())), (rows) => {
        const { store, flush } = held();
        store.apply({ type: "poses", at: "", poses: rows });
        flush();
        for (const pose of store.poses.values())
          expect(Number.isFinite(pose.x_m + pose.y_m + pose.heading_rad)).toBe(true);
      }),
      { seed: 7 },
    );
  });
});
