import fc from "fast-check";
import { expect, it } from "vitest";
import { detailOf, fitted, toHall, toScreen, zoomAt } from "./view";

const size = { width: 800, height: 600 };
const view = fc.record({
  cx: fc.double({ min: -200, max: 200, noNaN: true }),
  cy: fc.double({ min: -200, max: 200, noNaN: true }),
  pxPerM: fc.double({ min: 1, max: 400, noNaN: true }),
});
const at = fc.record({ x: fc.integer({ min: 0, max: 800 }), y: fc.integer({ min: 0, max: 600 }) });

it("comes back from the screen to the hall", () => {
  fc.assert(
    fc.property(view, at, (v, p) => {
      const back = toScreen(v, size, toHall(v, size, p));
      expect(back.x).toBeCloseTo(p.x, 6);
      expect(back.y).toBeCloseTo(p.y, 6);
    }),
    { seed: 5 },
  );
});

it("zooms around the finger", () => {
  fc.assert(
    fc.property(view, at, fc.double({ min: 0.1, max: 10, noNaN: true }), (v, p, factor) => {
      const before = toHall(v, size, p);
      const after = toHall(zoomAt(v, size, p, factor), size, p);
      expect(after.x_m).toBeCloseTo(before.x_m, 6);
      expect(after.y_m).toBeCloseTo(before.y_m, 6);
    }),
    { seed: 6 },
  );
});

it("shows north up and the whole box inside the margins", () => {
  const margins = { left: 50, top: 30, right: 20, bottom: 40 };
  const v = fitted({ minX: 0, minY: 0, maxX: 120, maxY: 60 }, size, margins);
  const southWest = toScreen(v, size, { x_m: 0, y_m: 0 });
  const northEast = toScreen(v, size, { x_m: 120, y_m: 60 });
  expect(northEast.y).toBeLessThan(southWest.y);
  expect(southWest.x).toBeGreaterThanOrEqual(50 - 1e-6);
  expect(northEast.x).toBeLessThanOrEqual(780 + 1e-6);
  expect(northEast.y).toBeGreaterThanOrEqual(30 - 1e-6);
  expect(southWest.y).toBeLessThanOrEqual(560 + 1e-6);
});

it.each([
  [7.9, "far"],
  [8, "middle"],
  [16, "near"],
  [40, "close"],
])("at %s px per m the detail is %s", (k, detail) => expect(detailOf(k)).toBe(detail));
