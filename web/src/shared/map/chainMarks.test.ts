import { expect, it } from "vitest";
import type { MarkerChain } from "@/shared/api/types";
import { chainMarks } from "./chainMarks";

const marker = (id: string, x_m: number) => ({
  marker: id,
  payload: id,
  place: { x_m, y_m: 2 },
  at_m: x_m,
  sigma_before_m: 0.004,
  sigma_after_m: 0.001,
});

it("marks nothing where nothing is said", () => {
  expect(chainMarks(undefined)).toEqual([]);
  expect(chainMarks({ markers: [], arrival_sigma_m: 0.002 })).toEqual([]);
});

it("marks the segment markers and the boundary marker", () => {
  const chain: MarkerChain = { markers: [marker("a", 5), marker("b", 12)], boundary: "b" };
  expect(chainMarks(chain)).toEqual([
    { kind: "segment", place: { x_m: 5, y_m: 2 } },
    { kind: "boundary", place: { x_m: 12, y_m: 2 } },
  ]);
});

it("marks where a code would help without a chain", () => {
  const reason = { code: "no_marker_chain", params: { gap_m: 30, at_most_m: 17, x_m: 40, y_m: 8 } };
  expect(chainMarks({ markers: [], reason })).toEqual([{ kind: "missing", place: { x_m: 40, y_m: 8 } }]);
});
