import fc from "fast-check";
import { expect, it } from "vitest";
import { boxesMeet } from "@/shared/math/geometry";
import { placePlates, plateBox, type PlateWish } from "./plates";

const hall = { minX: 0, minY: 0, maxX: 900, maxY: 450 };
const wish = (id: string, x: number, y: number, hw = 8, hh = 5): PlateWish => ({
  id,
  x,
  y,
  hw,
  hh,
  width: 22,
  height: 20,
});
const station = fc.record({
  x: fc.integer({ min: 20, max: 880 }),
  y: fc.integer({ min: 20, max: 430 }),
  hw: fc.integer({ min: 5, max: 60 }),
  hh: fc.integer({ min: 5, max: 60 }),
});
const halls = fc
  .array(station, { minLength: 1, maxLength: 40 })
  .map((all) => all.map((s, i) => wish(String(i), s.x, s.y, s.hw, s.hh)));

it("puts a plate at its own bracket, never over another plate", () => {
  fc.assert(
    fc.property(halls, (wishes) => {
      const plates = placePlates(wishes, hall, [], []);
      const boxes = wishes.flatMap((w) => {
        const plate = plates.get(w.id)!;
        // It touches the gap round its own bracket, on one side at least.
        expect(Math.abs(plate.dx)).toBeLessThanOrEqual(w.hw + w.width / 2 + 4);
        expect(Math.abs(plate.dy)).toBeLessThanOrEqual(w.hh + w.height / 2 + 4);
        return plate.free ? [plateBox(w, plate)] : [];
      });
      boxes.forEach((a, i) => boxes.forEach((b, k) => expect(i < k && boxesMeet(a, b)).toBe(false)));
    }),
    { seed: 5 },
  );
});

it("keeps every plate where it is when the map is dragged", () => {
  fc.assert(
    fc.property(
      halls,
      fc.integer({ min: -3000, max: 3000 }),
      fc.integer({ min: -3000, max: 3000 }),
      (w, x, y) => {
        const moved = { minX: hall.minX + x, maxX: hall.maxX + x, minY: hall.minY + y, maxY: hall.maxY + y };
        const there = placePlates(
          w.map((one) => ({ ...one, x: one.x + x, y: one.y + y })),
          moved,
          [],
          [],
        );
        expect([...there]).toEqual([...placePlates(w, hall, [], [])]);
      },
    ),
    { seed: 6 },
  );
});

it("never leaves the hall while one of its places lies inside", () => {
  const room = fc
    .record({ x: fc.integer({ min: 0, max: 900 }), y: fc.integer({ min: 40, max: 410 }) })
    .map(({ x, y }) => [wish("1", x, y)]);
  fc.assert(
    fc.property(room, (wishes) => {
      const box = plateBox(wishes[0]!, placePlates(wishes, hall, [], []).get("1")!);
      const inside = box.minX >= 0 && box.minY >= 0 && box.maxX <= 900 && box.maxY <= 450;
      const [w] = wishes;
      // Above and below need 12 px to either side, beside needs 34.
      if (w!.x >= 12 && w!.x <= 888) expect(inside).toBe(true);
    }),
    { seed: 7 },
  );
});

it("goes round a caption and the bracket of a neighbour", () => {
  const caption = { minX: 80, minY: 110, maxX: 200, maxY: 128 };
  const plates = placePlates([wish("1", 100, 100)], hall, [caption], []);
  expect(boxesMeet(plateBox(wish("1", 100, 100), plates.get("1")!), caption)).toBe(false);
  const two = [wish("1", 100, 100), wish("2", 100, 130, 30, 12)];
  const first = placePlates(two, hall, [], []).get("1")!;
  expect(first.dy).toBeLessThan(0);
});
