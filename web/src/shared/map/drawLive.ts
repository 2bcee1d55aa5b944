import { boxOf, splitPath } from "@/shared/math/geometry";
import { deviationBand } from "./deviationBand";
import { drawChain } from "./drawChain";
import { arrowHead, drawMove, drawSwept } from "./drawMove";
import type { Pen } from "./pen";
import type { DrawnVehicle, HallModel, MapOverlays } from "./scene";
import { detailOf } from "./view";

const kMinLengthPx = 10;
const kManyInView = 200;

/** What lies on the floor under the vehicles: horizon, grants, preview, loads. */
export function drawGround(pen: Pen, vehicles: readonly DrawnVehicle[], overlays: MapOverlays): void {
  const few = vehicles.length <= 40;
  for (const v of vehicles) if (v.selected) drawRoute(pen, v);
  for (const v of vehicles) if (!v.selected && ((few && v.moving) || v.blocker)) drawOtherRoute(pen, v);
  drawSwept(pen, overlays);
  for (const v of vehicles) if (v.stale) drawHeldFloor(pen, v);
  for (const v of vehicles) if (v.selected) drawChain(pen, v.vehicle.leg?.marker_chain);
  for (const v of vehicles) if (v.selected) drawDeviation(pen, v);
  for (const v of vehicles) if (v.loaded) drawLoad(pen, v, vehicles.length <= kManyInView);
}

/** The vehicles, and over them the move that is looked at. */
export function drawBodies(
  pen: Pen,
  model: HallModel,
  vehicles: readonly DrawnVehicle[],
  overlays: MapOverlays,
): void {
  for (const v of vehicles) drawVehicle(pen, v);
  drawMove(pen, model, overlays);
  drawChain(pen, overlays.chain);
}

function drawRoute(pen: Pen, v: DrawnVehicle): void {
  const { leg } = v.vehicle;
  if (leg === undefined) return;
  const { palette } = pen;
  for (const ring of leg.horizon_area ?? []) {
    pen.path(ring, true);
    pen.stroke(palette.horizon, 1, [2, 4], 0.8);
  }
  pen.g.beginPath();
  for (const ring of leg.granted_area) pen.path(ring, true, false);
  pen.fill(palette["grant-fill"]);
  pen.stroke(palette.grant, 1, [], 0.5);
  const granted = leg.path.slice(0, leg.granted_points);
  const [done, ahead] = splitPath(granted, v.pose);
  pen.path(done, false);
  pen.stroke(palette.grant, 1.5, [], 0.45);
  pen.path(leg.path.slice(Math.max(0, leg.granted_points - 1)), false);
  pen.stroke(palette.horizon, 2, [6, 5]);
  if (granted.length < 2) return;
  pen.path(ahead, false);
  pen.stroke(palette.grant, 4);
  arrowHead(pen, ahead, 11, true, palette.grant);
}

function drawOtherRoute(pen: Pen, v: DrawnVehicle): void {
  const { leg } = v.vehicle;
  if (leg === undefined || leg.granted_points < 2) return;
  const [, ahead] = splitPath(leg.path.slice(0, leg.granted_points), v.pose);
  pen.path(ahead, false);
  pen.stroke(pen.palette["ink-3"], 2);
  arrowHead(pen, ahead, 7, false, pen.palette["ink-3"]);
}

/** How far off, by its own word, the vehicle may be: three sigma, around where it holds itself to be. */
function drawDeviation(pen: Pen, v: DrawnVehicle): void {
  const band = deviationBand(v, pen.k);
  if (band === undefined) return;
  const { x, y } = pen.at(v.pose.x_m, v.pose.y_m);
  pen.g.beginPath();
  pen.g.save();
  pen.g.translate(x, y);
  pen.g.rotate(-v.pose.heading_rad);
  pen.g.roundRect(band.x, band.y, band.width, band.height, band.radius);
  pen.g.restore();
  pen.fill(pen.palette["grant-fill"]);
  pen.stroke(pen.palette["accent-line"], 1, [3, 3]);
}

/** Floor that a silent vehicle keeps. */
function drawHeldFloor(pen: Pen, v: DrawnVehicle): void {
  const { leg } = v.vehicle;
  pen.g.beginPath();
  for (const ring of leg?.granted_area ?? []) pen.path(ring, true, false);
  pen.stroke(pen.palette["ink-3"], 1, [2, 3]);
}

function drawLoad(pen: Pen, v: DrawnVehicle, fine: boolean): void {
  const { load_footprint: shape } = v.type;
  if (shape.length < 3) return;
  const { palette } = pen;
  pen.body(shape, v.pose);
  pen.fill(palette["map-craft"], 0.72);
  pen.stroke(v.selected ? palette["accent-line"] : palette["ink-2"], v.selected ? 2 : 1.5);
  if (!fine || detailOf(pen.k) === "far") return;
  const box = boxOf(shape);
  pen.body(
    [
      { x_m: box.minX - 0.8, y_m: 0 },
      { x_m: box.maxX + 0.8, y_m: 0 },
    ],
    v.pose,
  );
  pen.stroke(palette["map-craft-fine"], 1, [12, 3, 2, 3]);
}

interface Ink {
  body: string;
  line: string;
  mark: string;
  dash: readonly number[];
  width: number;
}

function inkOf(v: DrawnVehicle, p: Pen["palette"]): Ink {
  if (v.stale)
    return {
      body: p["map-lane"],
      line: v.selected ? p.accent : p["ink-2"],
      mark: p["ink-2"],
      dash: [4, 3],
      width: 1.75,
    };
  if (v.critical)
    return { body: p["critical-fill"], line: p.critical, mark: p["on-critical"], dash: [], width: 2 };
  if (v.blocked)
    return { body: p["high-fill"], line: p["high-edge"], mark: p["on-high"], dash: [], width: 2 };
  if (v.selected)
    return { body: p["veh-sel"], line: p["veh-halo"], mark: p["veh-sel-mark"], dash: [], width: 1.5 };
  return { body: p.veh, line: p["veh-halo"], mark: p["veh-mark"], dash: [], width: 1.5 };
}

function drawVehicle(pen: Pen, v: DrawnVehicle): void {
  const { g } = pen;
  const ink = inkOf(v, pen.palette);
  const box = boxOf(v.type.footprint);
  const length = (box.maxX - box.minX) * pen.k;
  const k = length < kMinLengthPx ? (pen.k * kMinLengthPx) / length : pen.k;
  const p = pen.at(v.pose.x_m, v.pose.y_m);
  g.save();
  g.translate(p.x, p.y);
  g.rotate(-v.pose.heading_rad);
  g.beginPath();
  v.type.footprint.forEach((q, i) =>
    i === 0 ? g.moveTo(q.x_m * k, -q.y_m * k) : g.lineTo(q.x_m * k, -q.y_m * k),
  );
  g.closePath();
  pen.fill(ink.body);
  pen.stroke(ink.line, ink.width, ink.dash);
  const detail = detailOf(pen.k);
  if ((detail === "near" || detail === "close") && !v.stale) {
    g.beginPath();
    const reported = new Map(v.vehicle.wheels.map((w) => [w.name, w.steering_rad]));
    for (const wheel of v.type.wheels) {
      g.save();
      g.translate(wheel.position.x_m * k, -wheel.position.y_m * k);
      g.rotate(-(reported.get(wheel.name) ?? 0));
      const r = (wheel.diameter_m / 2) * k;
      g.rect(-r, -r * 0.35, 2 * r, r * 0.7);
      g.restore();
    }
    pen.fill(ink.mark, 0.85);
    g.beginPath();
    for (const camera of v.type.cameras) {
      const c = camera.body_from_camera;
      g.moveTo(c.x_m * k + 4, -c.y_m * k);
      g.arc(c.x_m * k, -c.y_m * k, 4, 0, 7);
    }
    pen.stroke(ink.mark, 1.5);
  }
  // Front arrow, cut out of the body.
  const s = (box.maxY - box.minY) * 0.34;
  const tip = box.maxX - 0.47 * s;
  g.beginPath();
  for (const [i, [x, y]] of [
    [tip, 0],
    [tip - 1.59 * s, s],
    [tip - 1.18 * s, 0],
    [tip - 1.59 * s, -s],
  ].entries()) {
    if (i === 0) g.moveTo(x! * k, -y! * k);
    else g.lineTo(x! * k, -y! * k);
  }
  g.closePath();
  pen.fill(ink.mark);
  g.restore();
}
