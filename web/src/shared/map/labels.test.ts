import fc from "fast-check";
import { expect, it } from "vitest";
import { boxesMeet, ringMeetsBox } from "@/shared/math/geometry";
import { kSlots, placeLabels, slotCentre, type LabelWish } from "./labels";

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

it("leaves the head of an arrow free while there is another place", () => {
  const heads = [{ minX: 239, minY: 217, maxX: 261, maxY: 239 }];
  const one = [wish("a", 250, 200, { must: true })];
  const [label] = placeLabels(one, { bodies: [], soft: [], frame, heads }, new Map([["a", 0]]));
  expect(boxesMeet(boxAt(label!.x, label!.y), heads[0]!)).toBe(false);
  const everywhere = [{ minX: 0, minY: 0, maxX: 500, maxY: 400 }];
  expect(placeLabels(one, { bodies: [], soft: [], frame, heads: everywhere }, new Map())).toHaveLength(1);
});

const spots = fc.array(
  fc.record({
    x: fc.integer({ min: 20, max: 480 }),
    y: fc.integer({ min: 20, max: 380 }),
    vx: fc.integer({ min: -9, max: 9 }),
    vy: fc.integer({ min: -9, max: 9 }),
    must: fc.boolean(),
  }),
  { minLength: 1, maxLength: 24 },
);
const slotsOf = (placed: ReturnType<typeof placeLabels>) => new Map(placed.map((l) => [l.key, l.slot]));

it("covers no body while the label has a free place, and changes nothing when nothing changes", () => {
  fc.assert(
    fc.property(spots, (all) => {
      let slots = new Map<string, number>();
      for (let step = 0; step < 4; step++) {
        const wishes = all.map((s, i) =>
          wish(String(i), s.x + step * s.vx, s.y + step * s.vy, { must: s.must, rank: s.must ? 1 : 5 }),
        );
        const obstacles = { bodies: wishes.map((w) => ringOf(w.around)), soft: [], frame };
        const placed = placeLabels(wishes, obstacles, slots);
        slots = slotsOf(placed);
        for (const label of placed) {
          const box = boxAt(label.x, label.y);
          if (!obstacles.bodies.some((body) => ringMeetsBox(body, box))) continue;
          const own = wishes.find((w) => w.key === label.key)!;
          const bare = Array.from({ length: kSlots }, (_, i) => slotCentre(own, i)).filter(
            (c) => !obstacles.bodies.some((body) => ringMeetsBox(body, { ...boxAt(c.x, c.y) })),
          );
          // The margin of a pixel round a label counts as the label.
          expect(bare.filter((c) => !obstacles.bodies.some((b) => ringMeetsBox(b, padded(c))))).toEqual([]);
        }
        for (let again = 0; again < 3; again++) {
          expect(slotsOf(placeLabels(wishes, obstacles, slots))).toEqual(slots);
        }
      }
    }),
    { seed: 10 },
  );
  function padded(c: { x: number; y: number }) {
    const b = boxAt(c.x, c.y);
    return { minX: b.minX - 1, minY: b.minY - 1, maxX: b.maxX + 1, maxY: b.maxY + 1 };
  }
});

it("keeps clear of plates, which have their place already", () => {
  const one = [wish("a", 250, 200)];
  const below = slotCentre(one[0]!, 0);
  const fixed = [boxAt(below.x, below.y)];
  const [label] = placeLabels(one, { bodies: [], soft: [], fixed, frame }, new Map());
  expect(boxesMeet(boxAt(label!.x, label!.y), fixed[0]!)).toBe(false);
});

it("goes out of the hall, or over a plate, before it covers another label or is cut at the canvas's edge", () => {
  const hall = { minX: 180, minY: 150, maxX: 320, maxY: 250 };
  const canvas = { minX: 100, minY: 0, maxX: 500, maxY: 400 };
  const two = [wish("a", 250, 200, { must: true, rank: 0 }), wish("b", 250, 200, { must: true, rank: 1 })];
  const boxes = placeLabels(
    two,
    { bodies: [], soft: [], frame: hall, canvas, fixed: [canvas] },
    new Map(),
  ).map((l) => boxAt(l.x, l.y));
  expect(boxesMeet(boxes[0]!, boxes[1]!)).toBe(false);

  const edge = [wish("c", 120, 200, { must: true })];
  const [label] = placeLabels(edge, { bodies: [], soft: [], frame: hall, canvas }, new Map([["c", 3]]));
  expect(boxAt(label!.x, label!.y).minX).toBeGreaterThan(canvas.minX);
});
