import { boxesMeet, ringMeetsBox, type Box, type XY } from "@/shared/math/geometry";

/** A station's number plate and the bracket it belongs to, in pixels of the hall at one scale (y down). */
export interface PlateWish {
  id: string;
  x: number;
  y: number;
  /** Half size of the bracket as it is drawn. */
  hw: number;
  hh: number;
  width: number;
  height: number;
}

export interface Plate {
  /** Middle of the plate, seen from the station. */
  dx: number;
  dy: number;
  /** Clear of all other plates; else it is shown only where it must be. */
  free: boolean;
}

const kGap = 4;
const kWeight = { outside: 10_000, plate: 1000, caption: 200, bracket: 100, soft: 20 };

const boxOfPlate = (w: PlateWish, dx: number, dy: number): Box => ({
  minX: w.x + dx - w.width / 2 - 1,
  maxX: w.x + dx + w.width / 2 + 1,
  minY: w.y + dy - w.height / 2 - 1,
  maxY: w.y + dy + w.height / 2 + 1,
});

export const plateBox = (w: PlateWish, plate: Plate): Box => boxOfPlate(w, plate.dx, plate.dy);

/** Eight places that touch the bracket: below, above, beside, then the corners. */
function places({ hw, hh, width, height }: PlateWish): readonly { dx: number; dy: number }[] {
  const x = hw + width / 2 + kGap;
  const y = hh + height / 2 + kGap;
  return [
    { dx: 0, dy: y },
    { dx: 0, dy: -y },
    { dx: x, dy: 0 },
    { dx: -x, dy: 0 },
    { dx: -x, dy: -y + height },
    { dx: x, dy: -y + height },
    { dx: x, dy: y - height },
    { dx: -x, dy: y - height },
  ];
}

/**
 * Gives each plate its place at its own bracket. Only what stands still takes part (brackets, walls, captions, and as
 * `soft` obstacles and the outlines of loads that stop there) and all of the hall at once, so a plate moves neither with the vehicles nor when the map is dragged.
 */
export function placePlates(
  wishes: readonly PlateWish[],
  hall: Box,
  captions: readonly Box[],
  soft: readonly (readonly XY[])[],
): ReadonlyMap<string, Plate> {
  const brackets = wishes.map((w) => ({
    id: w.id,
    box: { minX: w.x - w.hw, maxX: w.x + w.hw, minY: w.y - w.hh, maxY: w.y + w.hh },
  }));
  const count = (boxes: readonly Box[], box: Box) =>
    boxes.reduce((n, other) => n + (boxesMeet(other, box) ? 1 : 0), 0);
  const taken: Box[] = [];
  const plates = new Map<string, Plate>();
  for (const wish of wishes) {
    let best: { cost: number; dx: number; dy: number; box: Box; clashes: number } | undefined;
    places(wish).forEach(({ dx, dy }, slot) => {
      const box = boxOfPlate(wish, dx, dy);
      const outside =
        box.minX < hall.minX || box.maxX > hall.maxX || box.minY < hall.minY || box.maxY > hall.maxY;
      const clashes = count(taken, box);
      const others = brackets.reduce((n, b) => n + (b.id !== wish.id && boxesMeet(b.box, box) ? 1 : 0), 0);
      const cost =
        (outside ? kWeight.outside : 0) +
        clashes * kWeight.plate +
        count(captions, box) * kWeight.caption +
        others * kWeight.bracket +
        soft.reduce((n, ring) => n + (ringMeetsBox(ring, box) ? 1 : 0), 0) * kWeight.soft +
        slot;
      if (best === undefined || cost < best.cost) best = { cost, dx, dy, box, clashes };
    });
    if (best === undefined) continue;
    if (best.clashes === 0) taken.push(best.box);
    plates.set(wish.id, { dx: best.dx, dy: best.dy, free: best.clashes === 0 });
  }
  return plates;
}
