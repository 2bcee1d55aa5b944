import { expect, it } from "vitest";
import type { JobOrder, Station, Vehicle } from "@/shared/api/types";
import { foundStations, grouped, openOrders, orderProgress, whatOf } from "./listRows";

const vehicle = (name: string, over: Partial<Vehicle> = {}): Vehicle => ({
  id: name,
  name,
  type: "t",
  link: "live",
  activity: "standing",
  pose_known: true,
  paused: false,
  needs_resume: false,
  integration: "utilise",
  battery_percent: 64.4,
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
const order = (number: number, over: Partial<JobOrder> = {}): JobOrder => ({
  id: String(number),
  number,
  name: `JO-${number}`,
  state: "AllowedToStart",
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
  revision: 1,
  ...over,
});
const numberOf = (id: string) => ({ st04: "4", st38: "38" })[id];

it("groups by need, the most urgent first, and finds by name", () => {
  const all = [
    vehicle("A"),
    vehicle("B", { link: "late" }),
    vehicle("C", { link: "gone" }),
    vehicle("D", { activity: "moving" }),
  ];
  expect(grouped(all, "").map((g) => [g.group, g.vehicles.map((v) => v.name)])).toEqual([
    ["attention", ["C", "B"]],
    ["moving", ["D"]],
    ["standing", ["A"]],
  ]);
  expect(grouped(all, " d ").map((g) => g.group)).toEqual(["moving"]);
});

it("finds a station by its exact number or part of its name", () => {
  const stations = [
    { number: 1, name: "Preparation" },
    { number: 11, name: "Wing" },
  ] as Station[];
  expect(foundStations(stations, "1").map((s) => s.number)).toEqual([1]);
  expect(foundStations(stations, "win").map((s) => s.number)).toEqual([11]);
  expect(foundStations(stations, "")).toEqual([]);
});

it.each<[Partial<Vehicle>, string]>([
  [{ at_station: "st04" }, "at"],
  [{}, "between"],
  [{ link: "never" }, "never"],
  [{ paused: true, pause: { with_fleet: true, stands: false }, activity: "moving" }, "stopping"],
  [{ paused: true, pause: { with_fleet: true, stands: true }, activity: "paused" }, "paused"],
  [{ activity: "charging", at_station: "st38" }, "charging"],
  [{ activity: "charging" }, "charging_between"],
])("says what %j does", (over, key) => expect(whatOf(vehicle("A", over), numberOf).key).toBe(key));

it("lists open orders, those under way first, then by priority", () => {
  const all = [
    order(1, { state: "Ended" }),
    order(2),
    order(3, { state: "Running" }),
    order(4, { priority: 5 }),
  ];
  expect(openOrders(all).map((o) => o.number)).toEqual([3, 4, 2]);
});

it("counts finished steps and the drive under way", () => {
  const steps = [
    { station: "a", number: 1, motion_mode: "auto", state: "done" },
    { station: "b", number: 2, motion_mode: "auto", state: "driving", leg: "L" },
  ] as JobOrder["steps"];
  const leg = { id: "L", progress: 0.5 } as NonNullable<Vehicle["leg"]>;
  expect(orderProgress(order(1, { steps, current_step: 1 }), leg)).toBe(0.75);
  expect(orderProgress(order(1), undefined)).toBe(0);
});
