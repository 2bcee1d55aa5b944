import fc from "fast-check";
import { expect, it } from "vitest";
import { boxOf, distanceToRing, inside, placed, ringMeetsBox, splitPath } from "./geometry";

const square = [
  { x: 0, y: 0 },
  { x: 10, y: 0 },
  { x: 10, y: 10 },
  { x: 0, y: 10 },
];
const real = fc.double({ min: -100, max: 100, noNaN: true });

it("tells inside from outside", () => {
  expect([inside(square, { x: 5, y: 5 }), inside(square, { x: 11, y: 5 })]).toEqual([true, false]);
  expect([distanceToRing(square, { x: 5, y: 5 }), distanceToRing(square, { x: 13, y: 14 })]).toEqual([0, 5]);
});

it("keeps lengths when it places a body", () => {
  fc.assert(
    fc.property(real, real, real, (x_m, y_m, heading_rad) => {
      const [a, b] = placed(
        [
          { x_m: -5, y_m: 1 },
          { x_m: 5, y_m: 1 },
        ],
        { x_m, y_m, heading_rad },
      );
      expect(Math.hypot(a!.x_m - b!.x_m, a!.y_m - b!.y_m)).toBeCloseTo(10, 9);
    }),
    { seed: 3 },
  );
});

it("turns counter-clockwise", () => {
  const [p] = placed([{ x_m: 1, y_m: 0 }], { x_m: 2, y_m: 3, heading_rad: Math.PI / 2 });
  expect(p!.x_m).toBeCloseTo(2);
  expect(p!.y_m).toBeCloseTo(4);
});

it.each([
  [{ minX: 2, minY: 2, maxX: 3, maxY: 3 }, true],
  [{ minX: -5, minY: -5, maxX: 50, maxY: 50 }, true],
  [{ minX: -5, minY: 4, maxX: 50, maxY: 6 }, true],
  [{ minX: 11, minY: 0, maxX: 12, maxY: 9 }, false],
])("sees whether a ring meets %j: %s", (box, meets) => expect(ringMeetsBox(square, box)).toBe(meets));

it("splits a path where the vehicle is", () => {
  const path = [
    { x_m: 0, y_m: 0 },
    { x_m: 10, y_m: 0 },
    { x_m: 10, y_m: 10 },
  ];
  const [done, ahead] = splitPath(path, { x_m: 4, y_m: 1 });
  expect(done).toEqual([path[0], { x_m: 4, y_m: 0 }]);
  expect(ahead).toEqual([{ x_m: 4, y_m: 0 }, path[1], path[2]]);
  expect(boxOf(path)).toEqual({ minX: 0, minY: 0, maxX: 10, maxY: 10 });
});
