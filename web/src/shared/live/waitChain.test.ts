import { expect, it } from "vitest";
import type { Params, Vehicle } from "@/shared/api/types";
import { eachOther, waitChain } from "./waitChain";

const waiting = (id: string, params: Params): Vehicle =>
  ({ id, activity: "waiting", reason: { code: "floor_held", params } }) as Vehicle;
const hall = (...all: Vehicle[]) => new Map(all.map((v) => [v.id, v]));
const moving = { id: "C", activity: "moving" } as Vehicle;

it.each<[string, Vehicle[], string[], boolean]>([
  ["nobody", [moving, waiting("A", {})], [], false],
  ["one that moves", [waiting("A", { by: "C" }), moving], ["C"], false],
  [
    "one that waits for a third",
    [waiting("A", { by: "B" }), waiting("B", { vehicle: "C" }), moving],
    ["B", "C"],
    false,
  ],
  ["a wall is no vehicle", [waiting("A", { by: "wall" })], [], false],
  ["not for itself", [waiting("A", { vehicle: "A" })], [], false],
  ["each other", [waiting("A", { by: "B" }), waiting("B", { by: "A" })], ["B"], true],
  [
    "two that wait for each other",
    [waiting("A", { by: "B" }), waiting("B", { by: "D" }), waiting("D", { by: "B" })],
    ["B", "D"],
    true,
  ],
  [
    "one that tells a cause while it moves",
    [{ ...waiting("A", { by: "C" }), activity: "moving" }, moving],
    [],
    false,
  ],
])("waits for %s", (_, vehicles, ids, loop) => {
  const all = hall(...vehicles);
  expect(waitChain(all.get("A")!, all)).toEqual({ ids, loop });
});

it("tells of two that wait for each other, and of nobody else", () => {
  const all = hall(waiting("A", { by: "B" }), waiting("B", { by: "A" }), waiting("E", { by: "A" }), moving);

  expect([...all.values()].map((v) => eachOther(v, all))).toEqual(["B", "A", undefined, undefined]);
});
