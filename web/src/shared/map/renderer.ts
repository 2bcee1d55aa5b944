import type { Vehicle } from "@/shared/api/types";
import { alarmOf, stale as isStale, type AlarmKind } from "@/shared/live/attention";
import { waitChain } from "@/shared/live/waitChain";
import { drawHall } from "./drawHall";
import { drawRulers } from "./drawFrame";
import { drawClosures } from "./drawClosures";
import { LabelPainter } from "./drawLabels";
import { drawBodies, drawGround } from "./drawLive";
import type { Palette } from "./palette";
import { Pen } from "./pen";
import type { DrawnVehicle, HallModel, LiveInput, MapLayers, MapOverlays } from "./scene";
import { toScreen, type Size, type View } from "./view";

export interface MapWords {
  old: (age: string) => string;
  north: string;
  /** Why floor is closed. */
  closure: (name: string) => string;
  /** A kind of alarm in a word or two. */
  alarm: (kind: AlarmKind) => string;
  /** Who drives a vehicle by hand; undefined: nobody. */
  inHand: (vehicle: Vehicle) => string | undefined;
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

/** Canvas2D. The hall is drawn once per view into a bitmap; each frame adds what moves. */
export class CanvasRenderer implements Renderer {
  drawn: readonly DrawnVehicle[] = [];
  private readonly g: CanvasRenderingContext2D;
  private readonly hall = document.createElement("canvas");
  private hallKey: readonly unknown[] = [];
  private readonly labels = new LabelPainter();

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
    drawClosures(pen, input.model, input.live.closures, input.overlays, input.words);
    drawGround(pen, inView, input.overlays);
    // Number plates lie on the floor: who drives over one is not hidden by it.
    const plates = input.layers.labels ? this.labels.drawPlates(pen, input) : [];
    drawBodies(pen, input.model, inView, input.overlays);
    // A tag that has no room in the hall lies over the ruler, not under its numbers.
    if (input.layers.rulers) drawRulers(pen, input.model, input.words.north);
    if (input.layers.labels) this.labels.drawTags(pen, input, inView, plates);
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
}

function drawnVehicles({ live, model, selected, nowMs }: FrameInput): DrawnVehicle[] {
  const drawn: DrawnVehicle[] = [];
  const chosen = selected === undefined ? undefined : live.vehicles.get(selected);
  const blockers = new Set(chosen && waitChain(chosen, live.vehicles).ids);
  for (const vehicle of live.vehicles.values()) {
    // Who has never told is presumed at home, and its floor there is held: drawn so, as what is not known.
    const told = live.poses.get(vehicle.id) ?? vehicle.pose;
    const pose = told ?? (vehicle.link === "never" ? model.homeOf.get(vehicle.id) : undefined);
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
      alarm: alarm?.kind,
      blocker: blockers.has(vehicle.id),
      inHand: vehicle.in_hand_of !== undefined,
      waiting: vehicle.activity === "waiting" || vehicle.activity === "paused" || vehicle.needs_resume,
      moving: vehicle.activity === "moving",
      loaded: vehicle.load_kg > 0,
      selected: vehicle.id === selected,
    });
  }
  // The selected one last, so that it lies on top.
  return drawn.sort((a, b) => Number(a.selected) - Number(b.selected));
}
