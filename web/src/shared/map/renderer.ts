import { age, fixed } from "@/shared/i18n/format";
import { alarmOf, stale as isStale, symbolOf } from "@/shared/live/attention";
import { boxOf, placed, type Box, type XY } from "@/shared/math/geometry";
import { drawHall } from "./drawHall";
import { drawRulers } from "./drawFrame";
import { drawLive } from "./drawLive";
import { placeLabels, slotCentre, type LabelWish } from "./labels";
import type { Palette } from "./palette";
import { Pen } from "./pen";
import type { DrawnVehicle, HallModel, LiveInput, MapLayers, MapOverlays } from "./scene";
import {
  drawStationTag,
  drawVehicleTag,
  stationTagSize,
  vehicleTagHeight,
  vehicleTagWidth,
  type StationTag,
  type VehicleTag,
} from "./tags";
import { detailOf, toScreen, type Size, type View } from "./view";

export interface MapWords {
  old: (age: string) => string;
  north: string;
  activity: (vehicle: string) => string;
}

export interface FrameInput {
  view: View;
  size: Size;
  dpr: number;
  palette: Palette;
  model: HallModel;
  layers: MapLayers;
  overlays: MapOverlays;
  live: LiveInput;
  selected: string | undefined;
  words: MapWords;
  nowMs: number;
}

export interface Renderer {
  draw(input: FrameInput): void;
  /** Vehicles as last drawn, for picking. */
  readonly drawn: readonly DrawnVehicle[];
}

const kLabelHoldMs = 500;
const kAllTagsUpTo = 40;
type Tag =
  | { kind: "vehicle"; tag: VehicleTag; width: number }
  | { kind: "station"; tag: StationTag; size: ReturnType<typeof stationTagSize> };

/** Canvas2D. The hall is drawn once per view into a bitmap; each frame adds what moves. */
export class CanvasRenderer implements Renderer {
  drawn: readonly DrawnVehicle[] = [];
  private readonly g: CanvasRenderingContext2D;
  private readonly hall = document.createElement("canvas");
  private hallKey: readonly unknown[] = [];
  private slots = new Map<string, number>();
  private slotsAt = -Infinity;
  private slotsKey = "";

  constructor(private readonly canvas: HTMLCanvasElement) {
    const context = canvas.getContext("2d", { alpha: false });
    if (context === null) throw new Error("no 2D canvas");
    this.g = context;
  }

  draw(input: FrameInput): void {
    const { size, dpr, view } = input;
    const width = Math.round(size.width * dpr);
    const height = Math.round(size.height * dpr);
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    this.drawHallOnce(input, width, height);
    const { g } = this;
    g.setTransform(1, 0, 0, 1, 0, 0);
    g.drawImage(this.hall, 0, 0);
    g.setTransform(dpr, 0, 0, dpr, 0, 0);
    const pen = new Pen(g, view, size, input.palette);
    this.drawn = drawnVehicles(input);
    const inView = this.drawn.filter((v) => {
      const p = toScreen(view, size, v.pose);
      return p.x > -200 && p.y > -200 && p.x < size.width + 200 && p.y < size.height + 200;
    });
    drawLive(pen, input.model, inView, input.overlays);
    if (input.layers.labels) this.drawLabels(pen, input, inView);
    if (input.layers.rulers) drawRulers(pen, input.model, input.words.north);
  }

  private drawHallOnce(input: FrameInput, width: number, height: number): void {
    const { view, model, layers, palette } = input;
    const key = [width, height, view.cx, view.cy, view.pxPerM, model, layers, palette];
    if (key.every((part, i) => part === this.hallKey[i]) && this.hallKey.length > 0) return;
    this.hallKey = key;
    this.hall.width = width;
    this.hall.height = height;
    const g = this.hall.getContext("2d", { alpha: false });
    if (g === null) return;
    g.setTransform(input.dpr, 0, 0, input.dpr, 0, 0);
    drawHall(new Pen(g, view, input.size, palette), model, layers);
  }

  private drawLabels(pen: Pen, input: FrameInput, inView: readonly DrawnVehicle[]): void {
    const { g } = this;
    const { palette, model, view, size } = input;
    const tags = new Map<string, Tag>();
    const wishes: LabelWish[] = [];
    const many = inView.length > kAllTagsUpTo;
    const ringOf = (v: DrawnVehicle, shape: DrawnVehicle["type"]["footprint"]): XY[] =>
      placed(shape, v.pose).map((p) => toScreen(view, size, p));
    const bodies = inView.map((v) => ringOf(v, v.type.footprint));
    const soft: XY[][] = inView.filter((v) => v.loaded).map((v) => ringOf(v, v.type.load_footprint));
    for (const area of model.areas) {
      if (area.kind === "obstacle") soft.push(area.outline.map((p) => toScreen(view, size, p)));
    }
    inView.forEach((v, i) => {
      const tag = vehicleTag(v, input);
      const far = detailOf(view.pxPerM) === "far";
      const important = v.selected || v.blocked || v.critical || v.stale || v.waiting;
      const platform = model.bracket.size > 0 && boxOf(v.type.footprint).maxX > 3;
      if (!important && (many || (far && !platform))) return;
      const width = vehicleTagWidth(g, tag, palette);
      tags.set(`v${v.vehicle.id}`, { kind: "vehicle", tag, width });
      wishes.push({
        key: `v${v.vehicle.id}`,
        rank: v.selected ? 0 : v.critical || v.blocked || v.stale ? 1 : v.waiting ? 2 : v.moving ? 4 : 5,
        must: v.selected || v.critical || v.blocked || v.stale,
        width,
        height: vehicleTagHeight,
        around: screenBox(bodies[i]!),
      });
    });
    this.stationWishes(input, tags, wishes);
    bodies.push(...this.zoneNames(pen, input));
    const frame: Box = { minX: 40, minY: 28, maxX: size.width - 2, maxY: size.height - 26 };
    const key = `${view.cx},${view.cy},${view.pxPerM},${size.width},${size.height},${wishes.length},${input.selected ?? ""}`;
    const fresh = key !== this.slotsKey || input.nowMs - this.slotsAt >= kLabelHoldMs;
    if (fresh) {
      this.slotsKey = key;
      this.slotsAt = input.nowMs;
      this.slots = new Map(
        placeLabels(wishes, { bodies, soft, frame }, this.slots).map((l) => [l.key, l.slot]),
      );
    }
    // Least important first, so that what matters lies on top.
    for (const wish of wishes.sort((a, b) => b.rank - a.rank)) {
      const slot = this.slots.get(wish.key);
      const tag = tags.get(wish.key);
      if (slot === undefined || tag === undefined) continue;
      const at = slotCentre(wish, slot);
      if (tag.kind === "vehicle") drawVehicleTag(g, tag.tag, at, tag.width, palette);
      else drawStationTag(g, tag.tag, at, tag.size, palette);
    }
  }

  private stationWishes(input: FrameInput, tags: Map<string, Tag>, wishes: LabelWish[]): void {
    const { model, view, size, live, palette } = input;
    const narrow = size.width < 1000;
    const far = detailOf(view.pxPerM) === "far";
    const goal = input.overlays.target ?? (input.selected && live.vehicles.get(input.selected)?.leg?.station);
    for (const station of model.stations) {
      const p = toScreen(view, size, station.pose);
      if (p.x < -60 || p.y < -60 || p.x > size.width + 60 || p.y > size.height + 60) continue;
      const bracket = model.bracket.get(station.id)!;
      const state = live.stations.get(station.id);
      const isGoal = station.id === goal;
      const look = isGoal
        ? "goal"
        : state?.occupied_by
          ? "occupied"
          : state?.reserved_by
            ? "reserved"
            : far && !bracket.big
              ? "bare"
              : "free";
      const tag: StationTag = { number: String(station.number), look, big: bracket.big };
      const tagSize = stationTagSize(this.g, tag, palette, narrow);
      const c = Math.abs(Math.cos(station.pose.heading_rad));
      const s = Math.abs(Math.sin(station.pose.heading_rad));
      // A bare number stands on the place itself; a plate beside its bracket.
      const shrink = look === "bare" || far ? 0 : view.pxPerM;
      const hw = (bracket.l * c + bracket.w * s) * shrink;
      const hh = (bracket.l * s + bracket.w * c) * shrink;
      const key = `s${station.id}`;
      tags.set(key, { kind: "station", tag, size: tagSize });
      wishes.push({
        key,
        rank: isGoal ? 3 : state?.occupied_by ? 4.5 : bracket.big ? 4.8 : 6,
        must: isGoal,
        on: look === "bare",
        width: tagSize.width,
        height: tagSize.height,
        around: { minX: p.x - hw, minY: p.y - hh, maxX: p.x + hw, maxY: p.y + hh },
      });
    }
  }

  /** Names the zones in their corners; labels keep clear of the names. */
  private zoneNames(pen: Pen, input: FrameInput): XY[][] {
    const { g } = this;
    const rings: XY[][] = [];
    const { palette } = input;
    g.font = `700 13px ${palette.font}`;
    g.textAlign = "left";
    g.textBaseline = "middle";
    for (const area of input.model.areas) {
      if (area.kind !== "zone" || area.name === "") continue;
      const box = boxOf(area.outline);
      const corner = pen.at(box.minX, box.maxY);
      const text = area.name.toLocaleUpperCase();
      const width = g.measureText(text).width;
      if (width > (box.maxX - box.minX) * pen.k - 8) continue;
      g.fillStyle = palette["map-zone"];
      g.fillRect(corner.x + 6, corner.y + 1, width + 12, 18);
      g.fillStyle = palette["ink-3"];
      g.fillText(text, corner.x + 12, corner.y + 11);
      const [x, y] = [corner.x + 6, corner.y + 1];
      rings.push([
        { x, y },
        { x: x + width + 12, y },
        { x: x + width + 12, y: y + 18 },
        { x, y: y + 18 },
      ]);
    }
    return rings;
  }
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

function drawnVehicles({ live, model, selected, nowMs }: FrameInput): DrawnVehicle[] {
  const drawn: DrawnVehicle[] = [];
  for (const vehicle of live.vehicles.values()) {
    const pose = live.poses.get(vehicle.id) ?? vehicle.pose;
    const type = model.types.get(vehicle.type);
    if (pose === undefined || type === undefined) continue;
    if (vehicle.hall !== undefined && vehicle.hall !== "" && vehicle.hall !== model.hall.id) continue;
    const heardAt = live.poses.get(vehicle.id)?.heardAt;
    const alarm = alarmOf(vehicle);
    drawn.push({
      vehicle,
      type,
      pose,
      ageS: heardAt === undefined ? Infinity : (nowMs - heardAt) / 1000,
      stale: live.linkLost || isStale(vehicle) || vehicle.link === "never",
      blocked: alarm?.priority === "high" && alarm.kind !== "silent",
      critical: alarm?.priority === "critical",
      waiting: vehicle.activity === "waiting" || vehicle.activity === "paused" || vehicle.needs_resume,
      moving: vehicle.activity === "moving",
      loaded: vehicle.load_kg > 0,
      selected: vehicle.id === selected,
    });
  }
  // The selected one last, so that it lies on top.
  return drawn.sort((a, b) => Number(a.selected) - Number(b.selected));
}

function vehicleTag(v: DrawnVehicle, input: FrameInput): VehicleTag {
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
    ? Number.isFinite(v.ageS)
      ? input.words.old(age(v.ageS))
      : ""
    : v.blocked || v.critical
      ? input.words.activity(v.vehicle.id)
      : v.selected && Math.abs(speed) > 0.005
        ? `${fixed(speed, 2)} m/s`
        : "";
  const symbol = v.stale ? "s-stale" : symbolOf(v.vehicle);
  return { name: v.vehicle.name, extra, symbol, look };
}
