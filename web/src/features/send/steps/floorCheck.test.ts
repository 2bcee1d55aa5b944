import { describe, expect, it } from "vitest";
import type { Closure, ModeOption } from "@/shared/api/types";
import { floorCheck } from "./floorCheck";

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
    expect(floorCheck(undefined, closures)).toBeUndefined();
    expect(floorCheck(option({ feasible: false }), closures)).toBeUndefined();
  });
  it("passes when the way leads round what is closed", () =>
    expect(floorCheck(option({}), closures)).toMatchObject({ result: "pass", params: { closed: 2 } }));
  it("fails with the names and the person when the only way leads over it", () =>
    expect(floorCheck(option({ closures: ["a", "b"] }), closures)).toEqual({
      code: "floor",
      result: "fail",
      params: { closure: "Wet floor, Work", by: "panel-2" },
    }));
  it("fails also when the closure is not known here yet", () =>
    expect(floorCheck(option({ closures: ["c"] }), closures)).toMatchObject({ result: "fail", params: {} }));
});
