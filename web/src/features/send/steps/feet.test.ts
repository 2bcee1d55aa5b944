import { describe, expect, it } from "vitest";
import type { DryRun, Vehicle } from "@/shared/api/types";
import { feetPlan, moveActions, previewWithFeet } from "./feet";

const on = (...extensions_m: number[]) => ({
  parking_feet: extensions_m.map((extension_m, i) => ({ name: String(i), extension_m })),
});

describe("feet around a move", () => {
  it("are raised first where one is down, and left alone where none is", () => {
    expect(feetPlan(on(0, 0.1, 0, 0), false, false)).toEqual({ raise: true, lower: false });
    expect(feetPlan(on(0, 0.001, 0, 0), false, false)).toEqual({ raise: false, lower: false });
  });
  it("are raised first behind another order, which may leave them down", () =>
    expect(feetPlan(on(0, 0, 0, 0), true, false).raise).toBe(true));
  it("are lowered after it where a person wants it", () => {
    expect(moveActions(feetPlan(on(0, 0, 0, 0), false, true), undefined, undefined)).toEqual({
      after: [{ type: "lowerParking" }],
    });
    expect(moveActions(feetPlan(on(0.1), false, true), undefined, undefined)).toEqual({
      before: [{ type: "raiseParking" }],
      after: [{ type: "lowerParking" }],
    });
  });
  it("are not lowered where a person does not want it, whatever the station is for", () =>
    expect(moveActions(feetPlan(on(0), false, false), undefined, undefined)).toEqual({ after: [] }));
  it("are lowered once the load is moved", () =>
    expect(
      moveActions(feetPlan(on(0), false, true), { type: "drop", load: "A-101", key: "" }, undefined).after,
    ).toEqual([{ type: "drop" }, { type: "lowerParking" }]));
  it("are lowered last, and brackets are at their height before the load is moved", () => {
    const brackets = { type: "setBracketHeight", parameters: { bracket: "all", height_m: 0.16 } };
    const drop = { type: "drop" as const, load: "A-101", key: "" };
    expect(moveActions(feetPlan(on(0), false, true), drop, brackets).after).toEqual([
      brackets,
      { type: "drop" },
      { type: "lowerParking" },
    ]);
    expect(moveActions(feetPlan(on(0), false, false), undefined, brackets)).toEqual({ after: [brackets] });
  });
  it("are nothing to a vehicle without any, or to none", () => {
    expect(moveActions(feetPlan({ parking_feet: [] }, true, true), undefined, undefined)).toEqual({
      after: [],
    });
    expect(moveActions(feetPlan(undefined as Vehicle | undefined, true, true), undefined, undefined)).toEqual(
      {
        after: [],
      },
    );
  });
});

describe("the checks of a move that raises them first", () => {
  const data = {
    checks: [
      { code: "parking_feet", result: "fail", params: { furthest_m: 0.12 } },
      { code: "mode", result: "note", params: { reason: "parking_feet_down" } },
      { code: "load", result: "fail", params: {} },
    ],
  } as unknown as DryRun;
  const results = (raise: boolean) => {
    const preview = previewWithFeet({ kind: "ready", data }, { raise, lower: false });
    return preview.kind === "ready" ? preview.data.checks.map((c) => c.result) : undefined;
  };
  it("tell of them and wait for nothing else of theirs", () =>
    expect(results(true)).toEqual(["note", "pass", "fail"]));
  it("fail where it does not", () => expect(results(false)).toEqual(["fail", "note", "fail"]));
  it("are left alone while there are none", () =>
    expect(previewWithFeet({ kind: "none" }, { raise: true, lower: false })).toEqual({ kind: "none" }));
});
