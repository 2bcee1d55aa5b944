import { age, fixed } from "@/shared/words/format";
import { symbolOf } from "@/shared/live/attention";
import { placed, type Box, type MetricPoint, type XY } from "@/shared/math/geometry";
import { captionsOf } from "./captions";
import { kFarSlot, placeLabels, slotCentre, type LabelWish } from "./labels";
import type { Pen } from "./pen";
import { placePlates, type Plate, type PlateWish } from "./plates";
import type { FrameInput } from "./renderer";
import type { DrawnVehicle, HallModel } from "./scene";
import { tagRule } from "./tagRule";
import {
  drawStationTag,
  stationTagSize,
  vehicleTagSize,
  drawVehicleTag,
  type StationTag,
  type VehicleTag,
} from "./tags";
import { detailOf, toScreen } from "./view";

const kLabelHoldMs = 500;
/** Half the box round an arrow's head. */
const kHeadPx = 11;
/** A bracket drawn smaller than this still keeps its plate off the place itself. */
const kLeastBracketPx = 7;
const kNarrowPx = 1000;

interface Shown {
  tag: VehicleTag;
  size: { width: number; height: number };
}

/** Number plates at their brackets and, round them and what stands there, the tags of the vehicles. */
export class LabelPainter {
  private slots = new Map<string, number>();
  private slotsAt = -Infinity;
  private slotsKey = "";
  private plates: ReadonlyMap<string, Plate> = new Map();
  private platesKey: readonly unknown[] = [];

  /** `fixedBoxes`: the plates, which tags keep clear of. */
  drawTags(pen: Pen, input: FrameInput, inView: readonly DrawnVehicle[], fixedBoxes: readonly Box[]): void {
    const { g } = pen;
    const { palette, model, view, size } = input;
    const tags = new Map<string, Shown>();
    const wishes: LabelWish[] = [];
    const ringOf = (v: DrawnVehicle, shape: DrawnVehicle["type"]["footprint"]): XY[] =>
      placed(shape, v.pose).map((p) => toScreen(view, size, p));
    const bodies = inView.map((v) => ringOf(v, v.type.footprint));
    const soft: XY[][] = inView.filter((v) => v.loaded).map((v) => ringOf(v, v.type.load_footprint));
    for (const area of model.areas) {
      if (area.kind === "obstacle") soft.push(area.outline.map((p) => toScreen(view, size, p)));
    }
    inView.forEach((v, i) => {
      const rule = tagRule(v, inView.length);
      if (rule === undefined) return;
      const tag = vehicleTag(v, input, detailOf(view.pxPerM) === "far" && rule.brief);
      const tagSize = vehicleTagSize(g, tag, palette);
      const key = v.vehicle.id;
      tags.set(key, { tag, size: tagSize });
      wishes.push({
        key,
        rank: rule.rank,
        must: rule.must,
        ...tagSize,
        around: screenBox(bodies[i]!),
      });
    });
    const frame = frameOf(input);
    const key = `${view.cx},${view.cy},${view.pxPerM},${size.width},${size.height},${wishes.length},${input.selected ?? ""}`;
    if (key !== this.slotsKey || input.nowMs - this.slotsAt >= kLabelHoldMs) {
      this.slotsKey = key;
      this.slotsAt = input.nowMs;
      const heads = [...inView.flatMap((v) => headBox(v, view, size)), ...captionBoxes(pen, input)];
      const canvas = { minX: 2, minY: 2, maxX: size.width - 2, maxY: size.height - 2 };
      const obstacles = { bodies, soft, frame, canvas, fixed: fixedBoxes, heads };
      this.slots = new Map(placeLabels(wishes, obstacles, this.slots).map((l) => [l.key, l.slot]));
    }
    // Least important first, so that what matters lies on top.
    for (const wish of wishes.sort((a, b) => b.rank - a.rank)) {
      const slot = this.slots.get(wish.key);
      const shown = tags.get(wish.key);
      if (slot === undefined || shown === undefined) continue;
      const at = slotCentre(wish, slot);
      if (slot >= kFarSlot) drawLeader(pen, wish, at);
      drawVehicleTag(g, shown.tag, at, shown.size, palette);
    }
  }

  /** Draws the plates; gives their boxes. */
  drawPlates(pen: Pen, input: FrameInput): Box[] {
    const { model, view, size, live, palette, layers } = input;
    const narrow = size.width < kNarrowPx;
    const wishes = plateWishes(pen, model, view.pxPerM, narrow);
    const platesKey = [model, view.pxPerM, narrow, layers, palette];
    if (platesKey.some((part, i) => part !== this.platesKey[i])) {
      this.platesKey = platesKey;
      this.plates = platesOf(pen, model, view.pxPerM, wishes);
    }
    const far = detailOf(view.pxPerM) === "far";
    const goal = input.overlays.target ?? (input.selected && live.vehicles.get(input.selected)?.leg?.station);
    const boxes: Box[] = [];
    model.stations.forEach((station, i) => {
      const wish = wishes[i]!;
      const plate = this.plates.get(station.id);
      const isGoal = station.id === goal;
      if (plate === undefined || !(plate.free || isGoal)) return;
      const p = toScreen(view, size, station.pose);
      const at = { x: p.x + plate.dx, y: p.y + plate.dy };
      if (at.x < -60 || at.y < -60 || at.x > size.width + 60 || at.y > size.height + 60) return;
      const state = live.stations.get(station.id);
      const off = input.overlays.choosable?.has(station.id) === false;
      const big = model.bracket.get(station.id)?.big ?? false;
      const look = isGoal
        ? "goal"
        : off
          ? "off"
          : state?.occupied_by
            ? "occupied"
            : state?.reserved_by
              ? "reserved"
              : far && !big
                ? "bare"
                : "free";
      const tag: StationTag = { number: String(station.number), look, big };
      drawStationTag(pen.g, tag, at, stationTagSize(pen.g, tag, palette, narrow), palette);
      boxes.push({
        minX: at.x - wish.width / 2,
        maxX: at.x + wish.width / 2,
        minY: at.y - wish.height / 2,
        maxY: at.y + wish.height / 2,
      });
    });
    return boxes;
  }
}

function plateWishes(pen: Pen, model: HallModel, k: number, narrow: boolean): PlateWish[] {
  return model.stations.map((station) => {
    const bracket = model.bracket.get(station.id)!;
    const tag: StationTag = { number: String(station.number), look: "free", big: bracket.big };
    const { width, height } = stationTagSize(pen.g, tag, pen.palette, narrow);
    const c = Math.abs(Math.cos(station.pose.heading_rad));
    const s = Math.abs(Math.sin(station.pose.heading_rad));
    return {
      id: station.id,
      x: station.pose.x_m * k,
      y: -station.pose.y_m * k,
      hw: Math.max(kLeastBracketPx, (bracket.l * c + bracket.w * s) * k),
      hh: Math.max(kLeastBracketPx, (bracket.l * s + bracket.w * c) * k),
      width,
      height,
    };
  });
}

function platesOf(pen: Pen, model: HallModel, k: number, wishes: readonly PlateWish[]) {
  const px = (b: Box): Box => ({ minX: b.minX * k, maxX: b.maxX * k, minY: -b.maxY * k, maxY: -b.minY * k });
  const captions = captionsOf(pen, model).map(({ width, height, area }) => {
    const box = px(area);
    return { minX: box.minX, minY: box.minY, maxX: box.minX + width + 6, maxY: box.minY + height + 2 };
  });
  const ring = (points: readonly MetricPoint[]): XY[] => points.map((p) => ({ x: p.x_m * k, y: -p.y_m * k }));
  const soft = model.areas.filter((a) => a.kind === "obstacle").map((a) => ring(a.outline));
  for (const station of model.stations) {
    const load = model.bracket.get(station.id)?.load;
    if (load !== undefined) soft.push(ring(placed(load, station.pose)));
  }
  return placePlates(wishes, px(model.box), captions, soft);
}

/** Tags stay on the canvas and inside the hall, as far as the hall is in view. */
function frameOf({ model, view, size, layers }: FrameInput): Box {
  const rim = layers.rulers
    ? { left: 40, top: 28, right: 2, bottom: 26 }
    : { left: 2, top: 2, right: 2, bottom: 2 };
  const a = toScreen(view, size, { x_m: model.box.minX, y_m: model.box.maxY });
  const b = toScreen(view, size, { x_m: model.box.maxX, y_m: model.box.minY });
  return {
    minX: Math.max(rim.left, a.x),
    minY: Math.max(rim.top, a.y),
    maxX: Math.min(size.width - rim.right, b.x),
    maxY: Math.min(size.height - rim.bottom, b.y),
  };
}

/** Where the names of zones stand. */
function captionBoxes(pen: Pen, { model, view, size }: FrameInput): Box[] {
  return captionsOf(pen, model).map(({ area, width, height }) => {
    const { x, y } = toScreen(view, size, { x_m: area.minX, y_m: area.maxY });
    return { minX: x + 6, minY: y + 1, maxX: x + 6 + width, maxY: y + 1 + height };
  });
}

/** Where the arrow of a vehicle's granted way ends. */
function headBox(v: DrawnVehicle, view: FrameInput["view"], size: FrameInput["size"]): Box[] {
  const { leg } = v.vehicle;
  const end = v.moving || v.selected ? leg?.path[leg.granted_points - 1] : undefined;
  if (end === undefined) return [];
  const { x, y } = toScreen(view, size, end);
  return [{ minX: x - kHeadPx, minY: y - kHeadPx, maxX: x + kHeadPx, maxY: y + kHeadPx }];
}

/** A hair from a label that had to go far out to its vehicle. */
function drawLeader(pen: Pen, wish: LabelWish, at: XY): void {
  const { around: b } = wish;
  pen.g.beginPath();
  pen.g.moveTo(at.x, at.y);
  pen.g.lineTo((b.minX + b.maxX) / 2, (b.minY + b.maxY) / 2);
  pen.stroke(pen.palette["ink-3"], 1);
}

function screenBox(ring: readonly XY[]): Box {
  const box = { minX: Infinity, minY: Infinity, maxX: -Infinity, maxY: -Infinity };
  for (const p of ring) {
    box.minX = Math.min(box.minX, p.x);
    box.minY = Math.min(box.minY, p.y);
    box.maxX = Math.max(box.maxX, p.x);
    box.maxY = Math.max(box.maxY, p.y);
  }
  return box;
}

function vehicleTag(v: DrawnVehicle, input: FrameInput, compact: boolean): VehicleTag {
  const look = v.stale
    ? "stale"
    : v.critical
      ? "critical"
      : v.blocked
        ? "high"
        : v.selected
          ? "selected"
          : "plain";
  const speed = input.live.poses.get(v.vehicle.id)?.speed_mps ?? v.vehicle.speed_mps ?? 0;
  const extra = v.stale
    ? v.vehicle.link === "never"
      ? ""
      : Number.isFinite(v.ageS)
        ? input.words.old(age(v.ageS))
        : ""
    : v.alarm !== undefined && (v.blocked || v.critical)
      ? input.words.alarm(v.alarm)
      : v.inHand
        ? (input.words.inHand(v.vehicle) ?? "")
        : v.selected && Math.abs(speed) > 0.005
          ? `${fixed(speed, 2)} m/s`
          : "";
  const symbol = v.stale ? "s-stale" : symbolOf(v.vehicle);
  return { name: v.vehicle.name, extra: compact ? "" : extra, symbol, look, compact };
}
