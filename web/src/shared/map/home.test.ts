import { expect, it } from "vitest";
import { homeView, withInSight } from "./home";
import { toScreen } from "./view";

const size = { width: 800, height: 600 };
const hall = { minX: 0, maxX: 120, minY: 0, maxY: 60 };

it("shows the whole hall, or what the page is about with room round it", () => {
  const whole = homeView(hall, undefined, size);
  expect(whole.pxPerM).toBeCloseTo((800 - 52 - 24) / 120);
  expect(homeView(hall, [{ x_m: 30, y_m: 30 }], size).pxPerM).toBeCloseTo((600 - 36 - 34) / 12);
});

it.each([
  ["in sight: the view stays", 60, 30, false],
  ["under the ruler", -1, 30, true],
  ["beyond the edge", 200, 30, true],
])("keeps a vehicle in sight: %s", (_, x_m, y_m, moved) => {
  const view = homeView(hall, undefined, size);
  const next = withInSight(view, size, { x_m, y_m });
  expect(next !== view).toBe(moved);
  if (moved) expect(toScreen(next, size, { x_m, y_m })).toEqual({ x: 400, y: 300 });
});
