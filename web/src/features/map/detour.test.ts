import { expect, it } from "vitest";
import type { Plant, Point } from "@/shared/api/types";
import { longWay } from "./detour";

// A ring of 100 m by 20 m, one way against the clock: a (0, 0), b (100, 0), c (100, 20), d (0, 20).
const at: Record<string, Point> = {
  a: { x_m: 0, y_m: 0 },
  b: { x_m: 100, y_m: 0 },
  c: { x_m: 100, y_m: 20 },
  d: { x_m: 0, y_m: 20 },
};
const plant = (edges: string[], only: string[] = []): Plant =>
  ({
    stations: [{ id: "s", node: "d" }],
    roadmap: {
      nodes: Object.entries(at).map(([id, position]) => ({ id, hall: "h", position })),
      edges: edges.map((e) => ({ id: e, from: e[0], to: e[1], vehicle_types: only })),
    },
  }) as unknown as Plant;
const ring = ["ab", "bc", "cd", "da"];
const along = (way: string) => ({ station: "s", path: [...way].map((id) => at[id]!) });

it.each<[string, Plant, string, string[], object | undefined]>([
  ["round the ring because it is one way", plant(ring), "abcd", [], { driven_m: 220, direct_m: 20 }],
  ["the lane back is open", plant([...ring, "ad"]), "abcd", [], undefined],
  ["the lane back is closed: not the arrows' fault", plant([...ring, "ad"]), "abcd", ["ad", "da"], undefined],
  ["straight", plant([...ring, "ad"]), "ad", [], undefined],
  ["its lanes are another type's", plant(ring, ["tug"]), "abcd", [], undefined],
])("%s", (_, model, way, closed, expected) => {
  expect(longWay(model, "cart", along(way), new Set(closed))).toEqual(expected);
});
