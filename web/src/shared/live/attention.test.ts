import { expect, it } from "vitest";
import type { Vehicle } from "@/shared/api/types";
import { alarmOf, alarms, groupOf, symbolOf } from "./attention";

const vehicle = (over: Partial<Vehicle>): Vehicle => ({
  id: "A",
  name: "A",
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
const fatal = [{ type: "x", fatal: true, description: "" }];

const wheel = (over: object) => ({
  name: "FL",
  steering_rad: 0,
  speed_mps: 0,
  temperature_c: 30,
  warm: false,
  fault: "",
  ...over,
});
const worst = (share: number) => ({
  worst_bracket: { bracket: "front left", share, limit: 0.1 },
  ...(Math.abs(share) > 0.1 && { load_fault: { code: "load_unbalanced", params: {} } }),
});
const because = (code: string) => ({ reason: { code, params: {} } });
const kNow = Date.parse("2026-11-24T20:15:00Z");
const ago = (s: number) => new Date(kNow - s * 1000).toISOString();

it.each<[string, Partial<Vehicle>, string | undefined, string | undefined]>([
  ["nothing", {}, undefined, undefined],
  ["the vehicle's own stop", { e_stop: "MANUAL" }, "e_stop", "critical"],
  ["a stop that is not pressed", { e_stop: "NONE" }, undefined, undefined],
  ["a fatal fault", { errors: fatal }, "error", "critical"],
  ["the monitor's stop", because("traffic_violation"), "traffic", "critical"],
  ["silence", { link: "lost" }, "silent", "high"],
  ["a violated field", { field_violation: true }, "field", "high"],
  ["a wheel's fault", { wheels: [wheel({ fault: "servo_overload" })] }, "wheel", "high"],
  ["a bracket 40 % over", worst(0.17), "bracket", "high"],
  ["a bracket that carries too little", worst(-0.11), "bracket", "high"],
  ["brackets that lean a little", worst(0.1), undefined, undefined],
  ["a load too heavy for it", { load_fault: { code: "load_too_heavy", params: {} } }, "load", "high"],
  ["an unknown pose", { pose_known: false }, "pose", "high"],
  [
    "a pose that it lost, and why",
    { pose_known: false, errors: [{ type: "poseUncertain", fatal: true, description: "" }] },
    "pose",
    "high",
  ],
  ["an unknown pose out of the hall", { pose_known: false, integration: "ignore" }, undefined, undefined],
  ["a stop that was not measured", because("stop_not_measured"), "stop", "high"],
  ["a stop out of tolerance", because("out_of_tolerance"), "tolerance", "high"],
  ["a refused order", because("order_rejected"), "refused", "high"],
  ["going aside again and again", { made_way: [ago(200), ago(90), ago(5)] }, "asides", "high"],
  ["having gone aside long ago", { made_way: [ago(400), ago(90), ago(5)] }, undefined, undefined],
  [
    "a restart of the server",
    { needs_resume: true, needs_resume_reason: because("server_restarted").reason },
    "person",
    "low",
  ],
  [
    "a vehicle that came back",
    { needs_resume: true, needs_resume_reason: because("vehicle_was_lost").reason },
    "person",
    "high",
  ],
  ["what bars it", { activity: "blocked" }, "blocked", "high"],
  ["a warning", { errors: [{ type: "x", fatal: false, description: "" }] }, "warning", "low"],
  [
    "going round something",
    { errors: [{ type: "going_round", fatal: false, description: "" }] },
    undefined,
    undefined,
  ],
  ["a wheel too hot", { wheels: [wheel({ warm: true, fault: "servo_overtemperature" })] }, "hot", "high"],
  [
    "a foot in the air",
    { errors: [{ type: "footLostContact", fatal: false, description: "" }] },
    "foot",
    "high",
  ],
  ["a warm wheel", { wheels: [wheel({ temperature_c: 71, warm: true })] }, "warm", "low"],
  ["late data", { link: "late" }, "late", "low"],
  ["waiting for floor", { activity: "waiting", ...because("floor_held") }, undefined, undefined],
])("has %s as an alarm, or none", (_, over, kind, priority) => {
  const alarm = alarmOf(vehicle(over), kNow);
  expect([alarm?.kind, alarm?.priority]).toEqual([kind, priority]);
});

it.each<[string, Partial<Vehicle>, string]>([
  ["the stop before the fault", { e_stop: "MANUAL", errors: fatal }, "e_stop"],
  ["the fault before the stop that failed", { errors: fatal, ...because("stop_not_measured") }, "error"],
  ["the field before the order", { field_violation: true, ...because("stop_not_measured") }, "field"],
  ["what is high before what is low", { link: "late", wheels: [wheel({ fault: "x" })] }, "wheel"],
])("tells %s", (_, over, kind) => expect(alarmOf(vehicle(over), kNow)?.kind).toBe(kind));

it.each<[string, Partial<Vehicle>, string, string]>([
  ["a fatal fault", { errors: fatal }, "attention", "a-1"],
  ["a violated field", { field_violation: true }, "attention", "a-2"],
  ["late data", { link: "late", activity: "moving" }, "attention", "s-stale"],
  ["a vehicle that needs a person", { needs_resume: true }, "attention", "a-2"],
  ["a lost position", { pose_known: false }, "attention", "a-2"],
  ["waiting", { activity: "waiting" }, "waiting", "s-wait"],
  ["a pause", { activity: "paused" }, "waiting", "s-wait"],
  ["driving", { activity: "moving" }, "moving", "s-moving"],
  ["charging", { activity: "charging" }, "standing", "s-charge"],
  ["standing on its feet", { parking_feet: [{ name: "1", extension_m: 0.1 }] }, "standing", "s-feet"],
  ["never connected", { link: "never", pose_known: false }, "standing", "s-stale"],
])("files %s", (_, over, group, symbol) => {
  expect([groupOf(vehicle(over)), symbolOf(vehicle(over))]).toEqual([group, symbol]);
});

it("puts the most urgent alarm first", () => {
  const all = alarms([
    vehicle({ id: "L", link: "late" }),
    vehicle({ id: "G", link: "gone" }),
    vehicle({ id: "F", errors: fatal }),
  ]);
  expect(all.map((a) => [a.vehicle, a.priority])).toEqual([
    ["F", "critical"],
    ["G", "high"],
    ["L", "low"],
  ]);
});
