import { expect, it } from "vitest";
import type { Leg } from "@/shared/api/types";
import { legProgress } from "./legProgress";

const leg = (progress: number, granted_points = 3): Leg => ({
  id: "l",
  station: "s",
  mode: "linear",
  path: [
    { x_m: 0, y_m: 0 },
    { x_m: 10, y_m: 0 },
    { x_m: 10, y_m: 10 },
    { x_m: 5, y_m: 10 },
    { x_m: 5, y_m: -5 },
  ].slice(0, 5),
  granted_points,
  granted_area: [],
  duration_s: 60,
  progress,
});
const kTotal = 40;

it.each<[string, Leg, [number, number] | undefined, number]>([
  ["between two nodes", leg(0), [4, 0.1], 4 / kTotal],
  ["round the corner", leg(0.25), [10, 4], 14 / kTotal],
  ["never behind what the server counts", leg(0.25), [4, 0], 10 / kTotal],
  ["not beyond what is granted", leg(0.25, 3), [5, 10], 10 / kTotal],
  ["where the way crosses itself, the part that comes next", leg(0, 5), [5, 0], 5 / kTotal],
  ["and behind it the other", leg(0.625, 5), [5, 0], 35 / kTotal],
  ["far beside it the server's word", leg(0.25), [30, 30], 10 / kTotal],
  ["no pose", leg(0.3), undefined, 0.3],
])("%s", (_, given, at, share) => {
  expect(legProgress(given, at && { x_m: at[0], y_m: at[1] })).toBeCloseTo(share, 3);
});

it("leaves a turn on the spot to the server", () => {
  const turn = { ...leg(0.4), path: [leg(0).path[0]!, leg(0).path[0]!] };
  expect(legProgress(turn, { x_m: 0, y_m: 0 })).toBe(0.4);
});
