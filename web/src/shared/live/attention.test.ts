import { expect, it } from "vitest";
import type { Vehicle } from "@/shared/api/types";
import { alarms, groupOf, symbolOf } from "./attention";

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

it.each<[string, Partial<Vehicle>, string, string]>([
  ["a fatal fault", { errors: fatal }, "attention", "a-1"],
  ["a violated field", { field_violation: true }, "attention", "a-2"],
  ["late data", { link: "late", activity: "moving" }, "attention", "s-stale"],
  ["a vehicle that needs a person", { needs_resume: true }, "attention", "s-wait"],
  ["a lost position", { pose_known: false }, "attention", "s-stand"],
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
