import { boxOf, type Box, type MetricPoint } from "@/shared/math/geometry";
import { fitted, toScreen, type Margins, type Size, type View } from "./view";

const kMargins: Margins = { left: 52, top: 36, right: 24, bottom: 34 };
/** On a phone the room is the hall's: no rulers. */
const kPhonePx = 560;
const kPhoneMargins: Margins = { left: 10, top: 10, right: 10, bottom: 10 };
const kRoom = 0.12;
const kLeastM = 12;

export const isPhone = (size: Size): boolean => size.width < kPhonePx;
export const marginsOf = (size: Size): Margins => (isPhone(size) ? kPhoneMargins : kMargins);

/** The view that nobody has changed: the whole hall, or what the page is about with some room round it. */
export function homeView(hall: Box, about: readonly MetricPoint[] | undefined, size: Size): View {
  if (about === undefined || about.length === 0) return fitted(hall, size, marginsOf(size));
  const b = boxOf(about);
  const x = Math.max(kRoom * (b.maxX - b.minX), (kLeastM - (b.maxX - b.minX)) / 2);
  const y = Math.max(kRoom * (b.maxY - b.minY), (kLeastM - (b.maxY - b.minY)) / 2);
  return fitted(
    { minX: b.minX - x, maxX: b.maxX + x, minY: b.minY - y, maxY: b.maxY + y },
    size,
    marginsOf(size),
  );
}

/** The view in which `point` can be seen: as it is where it can, else with the point in the middle. */
export function withInSight(view: View, size: Size, point: MetricPoint): View {
  const p = toScreen(view, size, point);
  const m = marginsOf(size);
  const seen = p.x > m.left && p.x < size.width - m.right && p.y > m.top && p.y < size.height - m.bottom;
  return seen ? view : { ...view, cx: point.x_m, cy: point.y_m };
}
