import { expect, it } from "vitest";
import type { StationState } from "@/shared/api/types";
import { lookOf } from "./stationLook";

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
