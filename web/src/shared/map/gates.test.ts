import { expect, it } from "vitest";
import type { Area, Ring } from "@/shared/api/types";
import { gatesOf } from "./gates";

const ring = (...points: [number, number][]): Ring => points.map(([x_m, y_m]) => ({ x_m, y_m }));
const hall = ring([0, 0], [120, 0], [120, 60], [0, 60]);
const area = (id: string, outline: Ring, kind: Area["kind"] = "no_go") =>
  ({ id, kind, name: id, hall: "h", outline }) as Area;
const south = ring([58, 0], [62, 0], [62, 2.2], [58, 2.2]);

it("draws a gate where the plant names one at the wall, opening inwards", () => {
  expect(gatesOf([area("gate-south", south)], hall)).toEqual([
    { a: { x_m: 58, y_m: 0 }, b: { x_m: 62, y_m: 0 }, inward: { x_m: 0, y_m: 1 } },
  ]);
  const east = area("door-east", ring([118, 20], [118, 24], [120, 24], [120, 20]));
  expect(gatesOf([east], hall)[0]?.inward).toEqual({ x_m: -1, y_m: 0 });
});

it.each([
  ["other floor to be kept free", area("pit-1", south)],
  ["one away from the wall", area("gate-inner", ring([50, 30], [54, 30], [54, 32], [50, 32]))],
  ["what may be driven on", area("gate-south", south, "zone")],
])("%s is no gate", (_, given) => expect(gatesOf([given], hall)).toEqual([]));
