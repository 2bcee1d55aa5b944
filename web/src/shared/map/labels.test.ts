import fc from "fast-check";
import { expect, it } from "vitest";
import { boxesMeet, ringMeetsBox } from "@/shared/math/geometry";
import { placeLabels, type LabelWish } from "./labels";

const frame = { minX: 0, minY: 0, maxX: 500, maxY: 400 };
const thing = (x: number, y: number) => ({ minX: x - 10, minY: y - 6, maxX: x + 10, maxY: y + 6 });
const ringOf = (b: ReturnType<typeof thing>) => [
  { x: b.minX, y: b.minY },
  { x: b.maxX, y: b.minY },
  { x: b.maxX, y: b.maxY },
  { x: b.minX, y: b.maxY },
];
const wish = (key: string, x: number, y: number, over: Partial<LabelWish> = {}): LabelWish => ({
  key,
  rank: 5,
  must: false,
  width: 60,
  height: 24,
  around: thing(x, y),
  ...over,
});
const boxAt = (x: number, y: number) => ({ minX: x - 30, minY: y - 12, maxX: x + 30, maxY: y + 12 });

it("lets no optional label touch another, a body, or the frame", () => {
  const spot = fc.record({ x: fc.integer({ min: 0, max: 500 }), y: fc.integer({ min: 0, max: 400 }) });
  fc.assert(
    fc.property(fc.array(spot, { maxLength: 40 }), (spots) => {
      const wishes = spots.map((s, i) => wish(String(i), s.x, s.y));
      const bodies = wishes.map((w) => ringOf(w.around));
      const boxes = placeLabels(wishes, { bodies, soft: [], frame }, new Map()).map((l) => boxAt(l.x, l.y));
      boxes.forEach((box, i) => {
        expect(bodies.some((body) => ringMeetsBox(body, box))).toBe(false);
        expect(boxes.some((other, k) => k !== i && boxesMeet(box, other))).toBe(false);
      });
    }),
    { seed: 9 },
  );
});

it("never drops a selected or alarmed one", () => {
  const wishes = Array.from({ length: 30 }, (_, i) =>
    wish(String(i), 250, 200, { must: i === 29, rank: i === 29 ? 0 : 5 }),
  );
  const placed = placeLabels(wishes, { bodies: [], soft: [], frame }, new Map());
  expect(placed.some((l) => l.key === "29")).toBe(true);
  expect(placed.length).toBeLessThan(30);
});

it("keeps its place while that is free", () => {
  const one = [wish("a", 250, 200)];
  const moved = placeLabels(one, { bodies: [], soft: [], frame }, new Map([["a", 6]]));
  expect(moved[0]?.slot).toBe(6);
});
