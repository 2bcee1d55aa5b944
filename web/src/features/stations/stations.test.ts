import { expect, it } from "vitest";
import type { Plant, StationState, StopRecord } from "@/shared/api/types";
import { newestByStation } from "./lastStops";
import { comingTo, lookOf } from "./stationLook";
import { foundStations, zoneOf } from "./stationSearch";

const state = (over: Partial<StationState>): StationState => ({
  station: "s",
  number: 1,
  occupied_by: "",
  reserved_by: "",
  ready: false,
  ...over,
});

it.each([
  [undefined, "free"],
  [state({}), "free"],
  [state({ reserved_by: "TP-01" }), "reserved"],
  [state({ occupied_by: "TP-01" }), "occupied"],
  [state({ occupied_by: "TP-01", ready: true }), "ready"],
  [state({ ready: true }), "free"],
])("%o is %s", (given, look) => expect(lookOf(given)).toBe(look));

it.each([
  [undefined, undefined],
  [state({}), undefined],
  [state({ reserved_by: "TP-02" }), "TP-02"],
  [state({ occupied_by: "TP-01", reserved_by: "TP-02" }), "TP-02"],
  [state({ occupied_by: "TP-01", reserved_by: "TP-01" }), undefined],
])("on its way to %o: %s", (given, who) => expect(comingTo(given)).toBe(who));

it("takes the newest stop of each station, whichever list has it", () => {
  const stop = (station: string, at: string) => ({ station, at }) as StopRecord;

  const newest = newestByStation([stop("a", "2"), stop("b", "1")], [stop("a", "1"), stop("b", "3")]);

  expect([...newest].map(([station, s]) => [station, s.at])).toEqual([
    ["a", "2"],
    ["b", "3"],
  ]);
});

it.each([
  ["", "1 2 12 28"],
  ["2", "2"], // a number is a whole number, not a digit of one
  [" 12 ", "12"],
  ["jig", "28"],
  ["WING", "2"],
  ["pulse", "1 2"],
  ["测量", "12"],
  ["nothing", ""],
])("a search for %j finds %j", (find, numbers) => {
  const stations = [
    { number: 1, name: "Conduits and cables", zone: "A Pulse line" },
    { number: 2, name: "Wings", zone: "A Pulse line" },
    { number: 12, name: "北侧跟踪仪位 2", zone: "B 测量厂房" },
    { number: 28, name: "Jig south 2", zone: "" },
  ];

  expect(
    foundStations(stations, find)
      .map((s) => s.number)
      .join(" "),
  ).toBe(numbers);
});

it.each([
  ["hall-3", 5, "B Measuring hall"],
  ["hall-3", 15, ""], // an aisle is no zone
  ["hall-4", 5, ""],
])("a station in %s at x %s m lies in zone %j", (hall, x_m, zone) => {
  const square = (from: number, to: number) =>
    [
      [from, 0],
      [to, 0],
      [to, 10],
      [from, 10],
    ].map(([x = 0, y = 0]) => ({ x_m: x, y_m: y }));
  const areas = [
    { id: "aisle", kind: "lane", name: "Aisle", hall: "hall-3", outline: square(10, 20) },
    { id: "b", kind: "zone", name: "B Measuring hall", hall: "hall-3", outline: square(0, 10) },
  ] as unknown as Plant["areas"];

  expect(zoneOf({ hall, pose: { x_m, y_m: 5, heading_rad: 0 } }, areas)).toBe(zone);
});
