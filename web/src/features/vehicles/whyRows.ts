import type { Reason, StationState, Vehicle, VehicleType } from "@/shared/api/types";
import { faultKey } from "@/shared/words/faults";
import { feetDown } from "@/shared/live/feet";
import { wheelState } from "@/shared/body/drawing/faceplate";
import { summarise } from "@/shared/body/drawing/loads";

/** One line under "Why is it standing?": what was looked at and what it says. */
export type WhyRow =
  | { kind: "link"; result: "pass" | "note" | "fail" }
  | { kind: "resume"; result: "fail" }
  | { kind: "order"; result: "pass" | "note" }
  | { kind: "station"; result: "pass" | "note"; state: StationState }
  | {
      kind: "load";
      result: "pass" | "note" | "fail";
      fault: Reason | undefined; // the rule that the load breaks
      empty: boolean;
      down: boolean;
    }
  | { kind: "wheel"; result: "note" | "fail"; wheel: Vehicle["wheels"][number] }
  | { kind: "wheels"; result: "pass"; count: number }
  | { kind: "fault"; result: "note" | "fail"; error: Vehicle["errors"][number] };

const rank = { fail: 0, note: 1, pass: 2 } as const;

/** What a person would look at next, worst first. Only what the vehicle or the server reported. */
export function whyRows(
  vehicle: Vehicle,
  type: VehicleType | undefined,
  target: StationState | undefined,
  stale: boolean,
): WhyRow[] {
  const rows: WhyRow[] = [];
  rows.push({
    kind: "link",
    result: vehicle.link === "late" ? "note" : vehicle.link !== "live" ? "fail" : stale ? "note" : "pass",
  });
  if (vehicle.needs_resume) rows.push({ kind: "resume", result: "fail" });
  // A wheel has a line of its own.
  for (const error of vehicle.errors.filter((e) => faultKey(e.type) !== "wheel_fault"))
    rows.push({ kind: "fault", result: error.fatal ? "fail" : "note", error });
  if (target) {
    const other = (target.occupied_by || target.reserved_by) !== vehicle.id;
    const taken = (target.occupied_by !== "" || target.reserved_by !== "") && other;
    rows.push({ kind: "station", result: taken ? "note" : "pass", state: target });
  }
  const load = summarise(vehicle, type);
  if (load) {
    rows.push({
      kind: "load",
      result: load.fault ? "fail" : "pass",
      fault: load.fault,
      empty: load.total_n < 1000,
      down: feetDown(vehicle.parking_feet),
    });
  }
  const odd = vehicle.wheels.filter((w) => wheelState(w) !== "ok");
  for (const wheel of odd) {
    rows.push({ kind: "wheel", result: wheelState(wheel) === "fault" ? "fail" : "note", wheel });
  }
  if (odd.length === 0 && vehicle.wheels.length > 0) {
    rows.push({ kind: "wheels", result: "pass", count: vehicle.wheels.length });
  }
  return rows.sort((a, b) => rank[a.result] - rank[b.result]);
}
