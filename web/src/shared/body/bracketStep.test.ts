import { describe, expect, it } from "vitest";
import type { VehicleType } from "@/shared/api/types";
import { bracketsWanted, liftOf } from "./bracketStep";

const type = (stroke_m: number | undefined, ...names: string[]) =>
  ({
    brackets: names.map((name) => ({ name, position: { x_m: 0, y_m: 0 } })),
    ...(stroke_m !== undefined && { bracket_lift: { stroke_m, speed_mps: 0.01 } }),
  }) as VehicleType;

describe("the brackets of whoever may come", () => {
  it.each([
    ["nobody known", [undefined], undefined],
    ["a type without brackets", [type(undefined)], undefined],
    ["one whose brackets do not move", [type(undefined, "a")], undefined],
    ["one that lifts", [type(0.3, "a", "b")], { stroke_m: 0.3, names: ["a", "b"] }],
    [
      "two kinds: what both have, as high as both reach",
      [type(0.3, "a", "b"), type(0.2, "b", "c"), type(undefined)],
      { stroke_m: 0.2, names: ["b"] },
    ],
  ])("%s", (_, types, lift) => expect(liftOf(types)).toEqual(lift));
});

describe("a height on arrival", () => {
  const lift = { stroke_m: 0.3, names: ["front left", "front right"] };
  const wanted = (bracket: string, text: string) => bracketsWanted({ bracket, text }, lift);
  it.each([
    ["all", "210", { bracket: "all", height_m: 0.21 }],
    ["all", "0", { bracket: "all", height_m: 0 }],
    ["all", "300", { bracket: "all", height_m: 0.3 }],
    ["front left", " 20.5 ", { bracket: "front left", height_m: 0.0205 }],
  ])("of %s, %s mm, is sent in metres", (bracket, text, parameters) =>
    expect(wanted(bracket, text)).toEqual({ action: { type: "setBracketHeight", parameters } }),
  );
  it.each([
    ["all", "", "empty"],
    ["all", "  ", "empty"],
    ["all", "301", "bad_height"],
    ["all", "-1", "bad_height"],
    ["all", "high", "bad_height"],
    ["back left", "20", "no_such_bracket"],
  ])("of %s, %j mm, is %s", (bracket, text, fault) => expect(wanted(bracket, text)).toEqual({ fault }));
  it("is none where nobody asks, or nobody who may come has brackets", () => {
    expect(bracketsWanted(undefined, lift)).toEqual({});
    expect(bracketsWanted({ bracket: "all", text: "10" }, undefined)).toEqual({});
  });
});
