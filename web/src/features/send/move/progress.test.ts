import { describe, expect, it } from "vitest";
import type { JobOrder, StopRecord, Vehicle } from "@/shared/api/types";
import { grantedShare, moveProgress, newestStop, reached } from "./progress";

const order = (over: Partial<JobOrder>): JobOrder =>
  ({
    id: "o",
    state: "Running",
    vehicle: "TP-01",
    steps: [{ state: "driving" }],
    current_step: 0,
    ...over,
  }) as JobOrder;
const leg = {
  progress: 0.4,
  path: [
    { x_m: 0, y_m: 0 },
    { x_m: 10, y_m: 0 },
    { x_m: 40, y_m: 0 },
  ],
  granted_points: 2,
};
const vehicle = (over: Partial<Vehicle>): Vehicle =>
  ({ id: "TP-01", order: "o", activity: "moving", leg, ...over }) as Vehicle;
const paused = (stands: boolean) => ({ paused: true, pause: { with_fleet: false, stands } });
const stop = (id: string, at: string): StopRecord => ({ id, order: "o", at }) as StopRecord;

describe("moveProgress", () => {
  it.each<[string, JobOrder | undefined, Vehicle | undefined, string]>([
    ["no order yet", undefined, undefined, "stored"],
    ["waiting for a vehicle", order({ state: "AllowedToStart", vehicle: "" }), undefined, "stored"],
    ["given to a vehicle that has not moved", order({}), vehicle({ activity: "waiting" }), "assigned"],
    ["vehicle moves for another order", order({}), vehicle({ order: "other" }), "assigned"],
    ["moving", order({}), vehicle({}), "moving"],
    [
      "measuring",
      order({ steps: [{ state: "measuring" }] as JobOrder["steps"] }),
      vehicle({ activity: "measuring" }),
      "measuring",
    ],
    ["paused", order({}), vehicle({ activity: "paused" }), "paused"],
    ["told to stand, braking", order({ state: "Interrupted" }), vehicle(paused(false)), "stopping"],
    ["told to stand, at rest", order({ state: "Interrupted" }), vehicle(paused(true)), "paused"],
    ["blocked", order({}), vehicle({ activity: "blocked" }), "held"],
    ["interrupted", order({ state: "Interrupted" }), vehicle({}), "held"],
    ["being cancelled, still moving", order({ cancel_requested: true }), vehicle({}), "cancelling"],
    ["ended", order({ state: "Ended" }), vehicle({}), "arrived"],
    ["aborted", order({ state: "Aborted" }), vehicle({}), "aborted"],
  ])("%s", (_, o, v, kind) => expect(moveProgress(o, v, []).kind).toBe(kind));
  it("never says confirmed before the vehicle moved", () => {
    expect(reached({ kind: "assigned" })).not.toContain("confirmed");
  });
  it("reads the released share from the path", () => expect(grantedShare(leg.path, 2)).toBe(0.25));
  it("takes a turn on the spot as released as a whole", () =>
    expect(grantedShare([{ x_m: 1, y_m: 1 }], 1)).toBe(1));
  it("shows the stop that the step names, else the newest of the order", () => {
    const stops = [stop("a", "2026-01-01T00:00:00Z"), stop("b", "2026-01-02T00:00:00Z")];

    expect(newestStop(order({ steps: [{ stop: "a" }] as JobOrder["steps"] }), stops)?.id).toBe("a");
    expect(newestStop(order({}), stops)?.id).toBe("b");
    expect(newestStop(order({ id: "x" }), stops)).toBeUndefined();
  });
});
