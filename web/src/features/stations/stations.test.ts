import { expect, it } from "vitest";
import type { StationState, StopRecord } from "@/shared/api/types";
import { newestByStation } from "./lastStops";
import { comingTo, lookOf } from "./stationLook";

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
