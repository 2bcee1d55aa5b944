import { boxesMeet, ringMeetsBox, type Box, type XY } from "@/shared/math/geometry";

/** Something that wants a label: a vehicle or a station. */
export interface LabelWish {
  key: string;
  /** Smaller comes first: selected, alarm, waiting, target station, moving, occupied station, the rest. */
  rank: number;
  /** Never dropped: selected and alarmed ones push. */
  must: boolean;
  width: number;
  height: number;
  /** The thing on the screen, around which places are tried. */
  around: Box;
}

export interface Obstacles {
  /** Never covered: vehicle bodies. */
  bodies: readonly XY[][];
  /** Covered only when nothing else is left: loads, aircraft. */
  soft: readonly XY[][];
  /** Labels that have their place already: number plates, names of closed floor. */
  fixed?: readonly Box[];
  /** Heads of the arrows that say where moving vehicles go, names of zones: covered only by what must be said. */
  heads?: readonly Box[];
  /** Where labels belong: the hall, as far as it is in view. */
  frame: Box;
  /** What is drawn on: a label over its edge is cut. */
  canvas?: Box;
}

export interface PlacedLabel {
  key: string;
  x: number;
  y: number;
  slot: number;
}

const kGap = 5;
export const kSlots = 40;
const kWeight = {
  cut: 9000,
  body: 5000,
  label: 3000,
  outside: 2000,
  plate: 1000,
  head: 300,
  soft: 20,
  moved: 30,
};

/** From here on a label stands so far out that a line has to say whose it is. */
export const kFarSlot = 8;

/** Centre of a label at one of eight places around the thing, then the same eight farther out, four times. */
export function slotCentre(wish: LabelWish, slot: number): XY {
  const { around: b, width, height } = wish;
  const far = Math.floor(slot / 8) * 22;
  const mx = (b.minX + b.maxX) / 2;
  const my = (b.minY + b.maxY) / 2;
  const dx = (b.maxX - b.minX) / 2 + width / 2 + kGap + far;
  const dy = (b.maxY - b.minY) / 2 + height / 2 + kGap + far;
  const places: readonly XY[] = [
    { x: mx, y: my + dy },
    { x: mx, y: my - dy },
    { x: mx + dx, y: my },
    { x: mx - dx, y: my },
    { x: mx - dx, y: my - dy + height },
    { x: mx + dx, y: my - dy + height },
    { x: mx + dx, y: my + dy - height },
    { x: mx - dx, y: my + dy - height },
  ];
  return places[slot % 8]!;
}

const boxAt = (c: XY, w: number, h: number, pad = 1): Box => ({
  minX: c.x - w / 2 - pad,
  minY: c.y - h / 2 - pad,
  maxX: c.x + w / 2 + pad,
  maxY: c.y + h / 2 + pad,
});

const boundsOf = (ring: readonly XY[]): Box => ({
  minX: Math.min(...ring.map((p) => p.x)),
  minY: Math.min(...ring.map((p) => p.y)),
  maxX: Math.max(...ring.map((p) => p.x)),
  maxY: Math.max(...ring.map((p) => p.y)),
});

/**
 * Puts labels in order of rank at the best free place of those around the thing. What finds none is left out, never
 * the thing it names; a label that must be shown takes the place that hides least, and a body is hidden last. A place
 * that was taken before is kept while another would not be much better: labels do not flicker.
 */
export function placeLabels(
  wishes: readonly LabelWish[],
  obstacles: Obstacles,
  previous: ReadonlyMap<string, number>,
): PlacedLabel[] {
  const withBounds = (rings: readonly XY[][]) => rings.map((ring) => ({ ring, bounds: boundsOf(ring) }));
  const bodies = withBounds(obstacles.bodies);
  const soft = withBounds(obstacles.soft);
  const hits = (items: typeof bodies, box: Box) =>
    items.reduce((n, item) => n + (boxesMeet(item.bounds, box) && ringMeetsBox(item.ring, box) ? 1 : 0), 0);
  const { frame, canvas = frame, fixed = [], heads = [] } = obstacles;
  const meets = (boxes: readonly Box[], box: Box) =>
    boxes.reduce((n, other) => n + (boxesMeet(other, box) ? 1 : 0), 0);
  const beyond = (limit: Box, box: Box) =>
    box.minX < limit.minX || box.minY < limit.minY || box.maxX > limit.maxX || box.maxY > limit.maxY;
  const taken: Box[] = [];
  const placed: PlacedLabel[] = [];
  for (const wish of [...wishes].sort((a, b) => a.rank - b.rank)) {
    let best: { cost: number; slot: number; centre: XY; box: Box } | undefined;
    const kept = previous.get(wish.key);
    for (let slot = 0; slot < kSlots; slot++) {
      const centre = slotCentre(wish, slot);
      const box = boxAt(centre, wish.width, wish.height);
      const outside = beyond(frame, box);
      const clashes = meets(taken, box);
      const plates = meets(fixed, box);
      const covered = hits(bodies, box);
      if (!wish.must && (outside || clashes + plates + covered > 0)) continue;
      const cost =
        covered * kWeight.body +
        (beyond(canvas, box) ? kWeight.cut : outside ? kWeight.outside : 0) +
        clashes * kWeight.label +
        plates * kWeight.plate +
        meets(heads, box) * kWeight.head +
        Math.min(10, hits(soft, box)) * kWeight.soft +
        slot -
        (slot === kept ? kWeight.moved : 0);
      if (best === undefined || cost < best.cost) best = { cost, slot, centre, box };
    }
    if (best === undefined) continue;
    taken.push(best.box);
    placed.push({ key: wish.key, x: best.centre.x, y: best.centre.y, slot: best.slot });
  }
  return placed;
}
