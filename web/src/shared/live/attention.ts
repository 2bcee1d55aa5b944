import type { Reason, Vehicle } from "@/shared/api/types";
import { bracketFault } from "./brackets";

export type Group = "attention" | "waiting" | "moving" | "standing";
export const kGroups: readonly Group[] = ["attention", "waiting", "moving", "standing"];

export type Priority = "critical" | "high" | "low";
export type AlarmKind =
  | "error"
  | "e_stop"
  | "traffic"
  | "silent"
  | "field"
  | "wheel"
  | "hot"
  | "foot"
  | "bracket"
  | "load"
  | "doubt"
  | "pose"
  | "stop"
  | "tolerance"
  | "refused"
  | "action"
  | "asides"
  | "person"
  | "blocked"
  | "warning"
  | "warm"
  | "charge"
  | "late";

export interface Alarm {
  vehicle: string;
  priority: Priority;
  kind: AlarmKind;
  /** Said with the words of this reason. */
  reason?: Reason;
  /** Said with the words of the kind, and these values. */
  fault?: string;
  wheel?: string;
  bracket?: string;
  share?: number;
  count?: number;
  temperature_c?: number;
}

export const pressed = (v: Vehicle) => v.e_stop !== undefined && v.e_stop !== "" && v.e_stop !== "NONE";
/** A person drives it, or it is being serviced: nobody can let it go on from here. */
export const inHand = (v: Vehicle) => v.operating_mode !== "AUTOMATIC";
export const silent = (v: Vehicle) => v.link === "lost" || v.link === "gone";
export const stale = (v: Vehicle) => v.link === "late" || silent(v);

/** So many times aside in so long: it gets nowhere. */
const kAsides = 3;
const kAsidesMs = 300_000;
/** It stands on its feet, and one of them does not hold as it should. */
const kFootFaults = new Set(["footLostContact", "footOverloaded"]);
/** Of a wheel's drive that has switched itself off until it has cooled. */
const kTooHot = "servo_overtemperature";
/** What is told as an error and needs nobody, or is told otherwise, as the fault of its load. */
const kNoFault = new Set(["going_round", "obstacle", "loadHalfTaken"]);
/** Why it does not know its place: nothing to clear at the vehicle, it only has to be told. */
const kPoseFaults = new Set(["poseUncertain", "contoursLost"]);

const kByReason: Readonly<Record<string, [AlarmKind, Priority]>> = {
  traffic_violation: ["traffic", "critical"],
  left_its_base: ["traffic", "critical"],
  load_too_heavy: ["load", "high"],
  load_unbalanced: ["load", "high"],
  bracket_overloaded: ["load", "high"],
  load_outside_wheel_base: ["load", "high"],
  load_outside_limits: ["load", "high"],
  pose_vague: ["pose", "low"],
  stop_not_measured: ["stop", "high"],
  out_of_tolerance: ["tolerance", "high"],
  order_rejected: ["refused", "high"],
  order_not_accepted: ["refused", "high"],
  action_failed: ["action", "high"],
  floor_conflict: ["blocked", "high"],
  charge_failed: ["charge", "low"],
  no_free_charger: ["charge", "low"],
};

/** What waits for a person as a matter of course: nothing is wrong with the vehicle. */
const kRoutine = new Set(["server_restarted", "integrated_again", "vehicle_restarted", "driven_by_hand"]);

type Cause = Omit<Alarm, "vehicle">;

/** Every cause there is, the most urgent of a priority first. */
function* causes(v: Vehicle, nowMs: number): Generator<Cause> {
  const fatal = v.errors.find((e) => e.fatal && (v.pose_known || !kPoseFaults.has(e.type)));
  if (pressed(v)) yield { kind: "e_stop", priority: "critical" };
  if (fatal !== undefined) yield { kind: "error", priority: "critical", fault: fatal.type };
  const told = v.reason === undefined ? undefined : kByReason[v.reason.code];
  if (told?.[0] === "traffic") yield { kind: "traffic", priority: told[1], reason: v.reason! };
  if (silent(v)) yield { kind: "silent", priority: "high" };
  if (v.field_violation === true) yield { kind: "field", priority: "high" };
  const wheel = v.wheels.find((w) => w.fault !== "");
  if (wheel?.fault === kTooHot)
    yield { kind: "hot", priority: "high", wheel: wheel.name, temperature_c: wheel.temperature_c };
  else if (wheel !== undefined)
    yield { kind: "wheel", priority: "high", wheel: wheel.name, fault: wheel.fault };
  const foot = v.errors.find((e) => kFootFaults.has(e.type));
  if (foot !== undefined) yield { kind: "foot", priority: "high", fault: foot.type };
  const bracket = bracketFault(v);
  const load = v.load_fault;
  if (bracket !== undefined) yield { kind: "bracket", priority: "high", ...bracket };
  else if (load !== undefined) yield { kind: "load", priority: "high", reason: load };
  if (v.claimed_pose !== undefined)
    yield {
      kind: "doubt",
      priority: "high",
      reason: v.needs_resume_reason ?? { code: "pose_jumped", params: {} },
    };
  const inHall = v.link !== "never" && v.integration !== "ignore" && v.integration !== "notice";
  if (!v.pose_known && inHall && v.claimed_pose === undefined) yield { kind: "pose", priority: "high" };
  if (told !== undefined) yield { kind: told[0], priority: told[1], reason: v.reason! };
  const asides = (v.made_way ?? []).filter((at) => nowMs - Date.parse(at) < kAsidesMs).length;
  if (asides >= kAsides) yield { kind: "asides", priority: "high", count: asides };
  if (v.needs_resume) {
    const reason = v.needs_resume_reason ?? { code: "needs_resume", params: {} };
    yield { kind: "person", priority: kRoutine.has(reason.code) ? "low" : "high", reason };
  }
  if (v.activity === "blocked")
    yield { kind: "blocked", priority: "high", ...(v.reason !== undefined && { reason: v.reason }) };
  const warning = v.errors.find((e) => !e.fatal && !kNoFault.has(e.type) && !kFootFaults.has(e.type));
  if (warning !== undefined) yield { kind: "warning", priority: "low", fault: warning.type };
  const warm = v.wheels.find((w) => w.warm);
  if (warm !== undefined)
    yield { kind: "warm", priority: "low", wheel: warm.name, temperature_c: warm.temperature_c };
  if (v.link === "late") yield { kind: "late", priority: "low" };
}

const kRank: Record<Priority, number> = { critical: 0, high: 1, low: 2 };

/** The most urgent alarm of a vehicle, if any. */
export function alarmOf(v: Vehicle, nowMs = Date.now()): Alarm | undefined {
  let urgent: Cause | undefined;
  for (const cause of causes(v, nowMs))
    if (urgent === undefined || kRank[cause.priority] < kRank[urgent.priority]) urgent = cause;
  return urgent && { vehicle: v.id, ...urgent };
}

/** Alarms of all vehicles, most urgent first. */
export function alarms(vehicles: Iterable<Vehicle>, nowMs = Date.now()): Alarm[] {
  const all: Alarm[] = [];
  for (const vehicle of vehicles) {
    const alarm = alarmOf(vehicle, nowMs);
    if (alarm !== undefined) all.push(alarm);
  }
  return all.sort((a, b) => kRank[a.priority] - kRank[b.priority]);
}

/** Where the list files a vehicle. Who measures its stop stands. */
export function groupOf(v: Vehicle): Group {
  if (alarmOf(v) !== undefined) return "attention";
  if (v.activity === "moving") return "moving";
  if (v.activity === "waiting" || v.activity === "paused") return "waiting";
  return "standing";
}

/** Shape that stands for what a vehicle does. */
export function symbolOf(
  v: Vehicle,
): "a-1" | "a-2" | "s-stale" | "s-wait" | "s-moving" | "s-measure" | "s-charge" | "s-feet" | "s-stand" {
  const alarm = alarmOf(v);
  if (v.link === "never" || alarm?.kind === "silent" || v.link === "late") return "s-stale";
  if (alarm?.priority === "critical") return "a-1";
  if (alarm?.priority === "high") return "a-2";
  if (v.needs_resume || v.activity === "waiting" || v.activity === "paused") return "s-wait";
  if (v.activity === "moving") return "s-moving";
  if (v.activity === "measuring") return "s-measure";
  if (v.activity === "charging") return "s-charge";
  return onFeet(v) ? "s-feet" : "s-stand";
}

export const onFeet = (v: Vehicle) =>
  v.parking_feet.length > 0 && v.parking_feet.every((f) => f.extension_m > 0.01);
