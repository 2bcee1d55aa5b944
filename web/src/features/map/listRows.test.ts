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

const kNow = Date.parse("2026-11-25T07:00:00Z");
const at = (s: number) => new Date(kNow + s * 1000).toISOString();

it("lists open orders by urgency: who needs a person, who is late, then by priority, due time and age", () => {
  const all = [
    order(1, { state: "Ended" }),
    order(2),
    order(3, { state: "Running" }),
    order(4, { priority: 5 }),
    order(5, { state: "Interrupted" }),
    order(6, { state: "Running", expected_at: at(-80) }),
    order(7, { due: at(600) }),
    order(8, { due: at(300) }),
    order(9, { state: "Interrupted", removed: true }),
    order(10, { state: "NotAllowedToStart", priority: 9 }),
  ];
  expect(openOrders(all, kNow).map((o) => o.number)).toEqual([5, 6, 3, 4, 8, 7, 2, 10]);
});

it("puts the one first that has waited longest, and leaves those that stand where they are", () => {
  const waiting = (name: string) => vehicle(name, { activity: "waiting" });
  const all = [vehicle("Z"), waiting("A"), waiting("B"), waiting("C"), vehicle("Y")];
  const since = new Map(
    [
      ["A", 30],
      ["B", 10],
      ["C", 20],
    ].map(([id, s]) => [String(id), { doing: "waiting", atMs: Number(s) * 1000, exact: true }]),
  );
  expect(grouped(all, "", since).map((g) => g.vehicles.map((v) => v.name))).toEqual([
    ["B", "C", "A"],
    ["Z", "Y"],
  ]);
});

it("files who measures its stop under standing", () => {
  const leg = { id: "L", station: "st04" } as NonNullable<Vehicle["leg"]>;
  const measuring = vehicle("A", { activity: "measuring", leg });
  expect(grouped([measuring], "").map((g) => g.group)).toEqual(["standing"]);
  expect(whatOf(measuring, numberOf)).toEqual({ key: "measuring", values: { station: "4" } });
});

const drive = { id: "L", station: "st04", started_at: at(0) } as NonNullable<Vehicle["leg"]>;
const own = order(1, {
  steps: [{ station: "st04", number: 4, motion_mode: "auto", state: "driving", leg: "L" }],
});
it.each<[string, Partial<Vehicle>, JobOrder | undefined, string]>([
  ["for its order", { order: "1" }, own, "to"],
  ["for an order that has yet to come in", { order: "1" }, undefined, "to"],
  ["aside, by its own reason", { reason: { code: "makes_way", params: {} } }, undefined, "makes_way"],
  ["aside, by when it last went", { made_way: [at(-90), at(0.05)] }, undefined, "makes_way"],
  ["to charge", { reason: { code: "goes_charging", params: {} } }, undefined, "charge"],
  ["aside while its order waits", { order: "1", made_way: [at(0)] }, order(1), "makes_way"],
  ["without an order", { made_way: [at(-90)] }, undefined, "aside"],
])("drives %s", (_, over, order, key) => {
  const moving = vehicle("A", { activity: "moving", leg: drive, ...over });
  expect(whatOf(moving, numberOf, order).key).toBe(key);
});

it("counts finished steps and the drive under way", () => {
  const steps = [
    { station: "a", number: 1, motion_mode: "auto", state: "done" },
    { station: "b", number: 2, motion_mode: "auto", state: "driving", leg: "L" },
  ] as JobOrder["steps"];
  const leg = { id: "L", progress: 0.5 } as NonNullable<Vehicle["leg"]>;
  expect(orderProgress(order(1, { steps, current_step: 1 }), leg)).toBe(0.75);
  expect(orderProgress(order(1, { steps, current_step: 1 }), leg, 0.8)).toBe(0.9);
  expect(orderProgress(order(1), undefined)).toBe(0);
});
