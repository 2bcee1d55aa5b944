import type { Vehicle } from "@/shared/api/types";

export type Group = "attention" | "waiting" | "moving" | "standing";
export const kGroups: readonly Group[] = ["attention", "waiting", "moving", "standing"];

export type AlarmKind = "error" | "e_stop" | "field" | "blocked" | "silent" | "late";
export interface Alarm {
  vehicle: string;
  priority: "critical" | "high" | "low";
  kind: AlarmKind;
  /** Type of the reported fault. */
  type?: string;
}

const stopped = (v: Vehicle) => v.e_stop !== undefined && v.e_stop !== "" && v.e_stop !== "NONE";
export const silent = (v: Vehicle) => v.link === "lost" || v.link === "gone";
export const stale = (v: Vehicle) => v.link === "late" || silent(v);

/** The most urgent alarm of a vehicle, if any. */
export function alarmOf(v: Vehicle): Alarm | undefined {
  const fatal = v.errors.find((e) => e.fatal);
  if (fatal !== undefined) return { vehicle: v.id, priority: "critical", kind: "error", type: fatal.type };
  if (stopped(v)) return { vehicle: v.id, priority: "critical", kind: "e_stop" };
  if (silent(v)) return { vehicle: v.id, priority: "high", kind: "silent" };
  if (v.field_violation === true) return { vehicle: v.id, priority: "high", kind: "field" };
  if (v.activity === "blocked") return { vehicle: v.id, priority: "high", kind: "blocked" };
  if (v.link === "late") return { vehicle: v.id, priority: "low", kind: "late" };
  return undefined;
}

const kRank = { critical: 0, high: 1, low: 2 } as const;

/** Alarms of all vehicles, most urgent first. */
export function alarms(vehicles: Iterable<Vehicle>): Alarm[] {
  const all: Alarm[] = [];
  for (const vehicle of vehicles) {
    const alarm = alarmOf(vehicle);
    if (alarm !== undefined) all.push(alarm);
  }
  return all.sort((a, b) => kRank[a.priority] - kRank[b.priority]);
}

/** Where the list files a vehicle. */
export function groupOf(v: Vehicle): Group {
  if (alarmOf(v) !== undefined || v.needs_resume) return "attention";
  if (v.link !== "never" && !v.pose_known) return "attention";
  if (v.activity === "moving" || v.activity === "measuring")
    return v.activity === "measuring" && v.leg === undefined ? "standing" : "moving";
  if (v.activity === "waiting" || v.activity === "paused") return "waiting";
  return "standing";
}

/** Shape that stands for what a vehicle does. */
export function symbolOf(
  v: Vehicle,
): "a-1" | "a-2" | "s-stale" | "s-wait" | "s-moving" | "s-measure" | "s-charge" | "s-feet" | "s-stand" {
  const alarm = alarmOf(v);
  if (v.link === "never" || alarm?.kind === "silent" || alarm?.kind === "late") return "s-stale";
  if (alarm !== undefined) return alarm.priority === "critical" ? "a-1" : "a-2";
  if (v.needs_resume || v.activity === "waiting" || v.activity === "paused") return "s-wait";
  if (v.activity === "moving") return "s-moving";
  if (v.activity === "measuring") return "s-measure";
  if (v.activity === "charging") return "s-charge";
  return onFeet(v) ? "s-feet" : "s-stand";
}

export const onFeet = (v: Vehicle) =>
  v.parking_feet.length > 0 && v.parking_feet.every((f) => f.extension_m > 0.01);
