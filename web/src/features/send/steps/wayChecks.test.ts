import { describe, expect, it } from "vitest";
import type { Closure, Load, ModeOption } from "@/shared/api/types";
import { codesCheck, floorCheck, withHands, type ShownCheck } from "./wayChecks";

const option = (over: Partial<ModeOption>): ModeOption => ({
  mode: "linear",
  feasible: true,
  suggested: true,
  ...over,
});
const closure = (id: string, name: string, by: string) =>
  ({ id, name, edges: [], created_by: by, created_at: "" }) as Closure;
const closures = [closure("a", "Wet floor", "panel-2"), closure("b", "Work", "panel-2")];

describe("the check of closed floor", () => {
  it("says nothing before there is a way", () => {
    expect(floorCheck(undefined, closures, [])).toBeUndefined();
    expect(floorCheck(option({ feasible: false }), closures, [])).toBeUndefined();
  });
  it("passes when the way leads round what is closed", () =>
    expect(floorCheck(option({}), closures, [])).toMatchObject({ result: "pass", params: { closed: 2 } }));
  it("fails with the names and the person when the only way leads over it", () =>
    expect(floorCheck(option({ closures: ["a", "b"] }), closures, [])).toEqual({
      code: "floor",
      result: "fail",
      params: { closure: "Wet floor, Work", by: "panel-2" },
    }));
  it("fails with the names of loads that what it carries would run into", () => {
    const loads = [{ id: "l-1", name: "A-102" } as Load];
    expect(floorCheck(option({ loads_in_the_way: ["l-1", "l-2"] }), closures, loads)).toEqual({
      code: "floor",
      result: "fail",
      params: { load: "A-102, l-2" },
    });
  });
  it("fails also when the closure is not known here yet", () =>
    expect(floorCheck(option({ closures: ["c"] }), closures, [])).toMatchObject({
      result: "fail",
      params: {},
    }));
});

describe("the check of codes on the way", () => {
  const gap = (widest_gap_m: number, at_most_m: number) =>
    option({ codes_on_way: { widest_gap_m, at_most_m } });
  it("says nothing where the vehicle needs none, and where it catches each", () => {
    expect(codesCheck(undefined)).toBeUndefined();
    expect(codesCheck(option({}))).toBeUndefined();
    expect(codesCheck(gap(9.2, 17.3))).toBeUndefined();
    expect(codesCheck({ ...gap(52, 17.3), feasible: false })).toBeUndefined();
  });
  it("notes where one would help", () => {
    const params = { gap_m: 40, at_most_m: 17, x_m: 20, y_m: 30 };
    const chain = { markers: [], reason: { code: "no_marker_chain", params } };
    expect(codesCheck({ ...gap(52, 17.3), marker_chain: chain })).toEqual({
      code: "codes_on_way",
      result: "note",
      params: { widest_gap_m: 40, at_most_m: 17, x_m: 20, y_m: 30 },
    });
    expect(codesCheck(option({ marker_chain: { markers: [] } }))).toBeUndefined();
  });
  it("notes how far it would drive without one", () =>
    expect(codesCheck(gap(52, 17.3))).toEqual({
      code: "codes_on_way",
      result: "note",
      params: { widest_gap_m: 52, at_most_m: 17.3 },
    }));
});

describe("a vehicle in a person's hands", () => {
  const mode: ShownCheck = {
    code: "mode",
    result: "note",
    params: { reason: "not_automatic", operating_mode: "MANUAL" },
  };
  const load: ShownCheck = { code: "load", result: "note", params: {} };
  it("is told with that person, whatever else bars it", () =>
    expect(withHands([mode, load], { in_hand_of: "ann" })).toEqual([
      { ...mode, params: { reason: "driven_by_hand", operating_mode: "MANUAL", person: "ann" } },
      load,
    ]));
  it.each([
    ["in nobody's", {}, mode],
    ["not chosen yet", undefined, mode],
    ["ready all the same", { in_hand_of: "ann" }, { ...mode, result: "pass" as const }],
  ])("%s: as the server says", (_, vehicle, check) => expect(withHands([check], vehicle)).toEqual([check]));
});
