import { drawCaptions } from "./captions";
import type { Pen } from "./pen";
import type { HallModel, MapLayers } from "./scene";
import { detailOf } from "./view";

const kChain = [14, 3, 3, 3];
const kWallM = 0.6;
const kChevronM = 20;

/** Everything that stands still: floor, grid, zones, lanes, walls, obstacles, markers, station brackets. */
export function drawHall(pen: Pen, model: HallModel, layers: MapLayers): void {
  const { g, palette, size } = pen;
  g.lineJoin = "round";
  g.fillStyle = palette["map-out"];
  g.fillRect(0, 0, size.width, size.height);
  pen.path(model.hall.outline, true);
  pen.stroke(palette["map-wall"], Math.max(6, kWallM * 2 * pen.k));
  pen.fill(palette["map-floor"]);
  g.save();
  pen.path(model.hall.outline, true);
  g.clip();
  drawZones(pen, model);
  drawGrid(pen, model);
  drawLaneAreas(pen, model);
  if (layers.roadmap) drawLanes(pen, model);
  g.restore();
  if (layers.markers && detailOf(pen.k) !== "far") drawMarkers(pen, model);
  if (layers.markers) {
    drawTransmitters(pen, model);
    drawReflectors(pen, model);
  }
  drawGates(pen, model);
  drawBrackets(pen, model);
  drawObstacles(pen, model);
  if (layers.labels) drawCaptions(pen, model);
}

function drawGrid(pen: Pen, model: HallModel): void {
  const { box } = model;
  const lines = (step: number, skip: number, colour: string) => {
    pen.g.beginPath();
    for (let x = Math.ceil(box.minX / step) * step; x <= box.maxX; x += step) {
      if (skip > 0 && x % skip === 0) continue;
      const s = Math.round(pen.at(x, 0).x) + 0.5;
      pen.g.moveTo(s, pen.at(x, box.minY).y);
      pen.g.lineTo(s, pen.at(x, box.maxY).y);
    }
    for (let y = Math.ceil(box.minY / step) * step; y <= box.maxY; y += step) {
      if (skip > 0 && y % skip === 0) continue;
      const s = Math.round(pen.at(0, y).y) + 0.5;
      pen.g.moveTo(pen.at(box.minX, y).x, s);
      pen.g.lineTo(pen.at(box.maxX, y).x, s);
    }
    pen.stroke(colour, 1);
  };
  if (pen.k >= 30) lines(1, 5, pen.palette["map-grid"]);
  if (pen.k >= 3) lines(5, 10, pen.palette["map-grid"]);
  lines(10, 0, pen.palette["map-grid-10"]);
}

function drawZones(pen: Pen, model: HallModel): void {
  const { palette } = pen;
  for (const area of model.areas.filter((a) => a.kind === "zone")) {
    pen.path(area.outline, true);
    pen.fill(palette["map-zone"]);
    pen.stroke(palette["map-rule"], 1, [10, 3, 2, 3], 0.55);
  }
}

function drawLaneAreas(pen: Pen, model: HallModel): void {
  const { palette } = pen;
  // All lanes as one shape: crossing lanes must not show their edges inside one another.
  const lanes = model.areas.filter((a) => a.kind === "lane");
  for (const lane of lanes) {
    pen.path(lane.outline, true);
    pen.stroke(palette["map-grid-10"], 2.5);
  }
  for (const lane of lanes) {
    pen.path(lane.outline, true);
    pen.fill(palette["map-lane"]);
  }
  for (const area of model.areas.filter((a) => a.kind === "no_go")) {
    pen.path(area.outline, true);
    pen.fill(palette["map-zone"]);
    pen.path(area.outline, true);
    pen.hatch(palette["map-craft-fine"], 8, 1);
    pen.path(area.outline, true);
    pen.stroke(palette["map-station"], 1);
  }
}

function drawLanes(pen: Pen, model: HallModel): void {
  const { g, palette } = pen;
  for (const big of [false, true]) {
    g.beginPath();
    for (const lane of model.lanes) {
      if (lane.big !== big) continue;
      const a = pen.at(lane.ax, lane.ay);
      const b = pen.at(lane.bx, lane.by);
      g.moveTo(a.x, a.y);
      g.lineTo(b.x, b.y);
    }
    pen.stroke(palette["map-route"], big ? 1.5 : 1, kChain);
  }
  if (detailOf(pen.k) === "far") return;
  const s = Math.max(4, Math.min(9, 0.4 * pen.k));
  g.beginPath();
  for (const lane of model.lanes) {
    const length = Math.hypot(lane.bx - lane.ax, lane.by - lane.ay);
    if (!lane.oneWay || length < 3) continue;
    const ux = (lane.bx - lane.ax) / length;
    const uy = -(lane.by - lane.ay) / length;
    const count = Math.max(1, Math.round(length / kChevronM));
    for (let i = 0; i < count; i++) {
      const t = (i + 0.5) / count;
      const c = pen.at(lane.ax + t * (lane.bx - lane.ax), lane.ay + t * (lane.by - lane.ay));
      g.moveTo(c.x - ux * s * 0.75 - uy * s, c.y - uy * s * 0.75 + ux * s);
      g.lineTo(c.x + ux * s * 0.4, c.y + uy * s * 0.4);
      g.lineTo(c.x - ux * s * 0.75 + uy * s, c.y - uy * s * 0.75 - ux * s);
    }
  }
  pen.stroke(palette["map-chevron"], 1.5);
}

/** An opening in the wall and its two leaves, as drawings have them. */
function drawGates(pen: Pen, model: HallModel): void {
  const { g, palette } = pen;
  for (const { a, b, inward } of model.gates) {
    const [p, q] = [pen.at(a.x_m, a.y_m), pen.at(b.x_m, b.y_m)];
    g.beginPath();
    g.moveTo(p.x, p.y);
    g.lineTo(q.x, q.y);
    pen.stroke(palette["map-floor"], Math.max(6, kWallM * 2 * pen.k) + 1);
    const leaf = Math.hypot(q.x - p.x, q.y - p.y) / 2;
    const along = Math.atan2(q.y - p.y, q.x - p.x);
    // Screen y points down.
    const open = Math.atan2(-inward.y_m, inward.x_m);
    g.beginPath();
    for (const [hinge, shut] of [
      [p, along],
      [q, along + Math.PI],
    ] as const) {
      const turn = Math.sin(open - shut);
      g.moveTo(hinge.x, hinge.y);
      g.lineTo(hinge.x + leaf * Math.cos(open), hinge.y + leaf * Math.sin(open));
      g.arc(hinge.x, hinge.y, leaf, open, shut, turn > 0);
    }
    pen.stroke(palette["map-wall"], 1.5);
  }
}

function drawObstacles(pen: Pen, model: HallModel): void {
  const { palette } = pen;
  for (const area of model.areas.filter((a) => a.kind === "obstacle")) {
    pen.path(area.outline, true);
    pen.fill(palette["map-craft"]);
    pen.stroke(palette["map-craft-line"], 1.25);
  }
}

function drawMarkers(pen: Pen, model: HallModel): void {
  const { g, palette } = pen;
  const close = detailOf(pen.k) === "close";
  for (const marker of model.markers) {
    const p = pen.at(marker.pose.x_m, marker.pose.y_m);
    if (p.x < -20 || p.y < -20 || p.x > pen.size.width + 20 || p.y > pen.size.height + 20) continue;
    // True size once that can be seen, before it a dot.
    const half = Math.max(2, (marker.size_m * pen.k) / 2);
    g.beginPath();
    if (marker.kind === "landmark") {
      g.arc(p.x, p.y, Math.max(3, half), 0, 7);
      pen.stroke(palette["map-marker"], 1.25);
      g.beginPath();
      g.arc(p.x, p.y, 1, 0, 7);
      pen.fill(palette["map-marker"]);
    } else {
      g.save();
      g.translate(p.x, p.y);
      g.rotate(-marker.pose.heading_rad);
      g.rect(-half, -half, 2 * half, 2 * half);
      g.restore();
      pen.fill(palette["map-marker"]);
    }
    if (close) {
      g.font = `12px ${palette.font}`;
      g.fillStyle = palette["ink-3"];
      g.textAlign = "left";
      g.textBaseline = "middle";
      g.fillText(marker.payload, p.x + half + 5, p.y);
    }
  }
}

/** What a thing is called, to the right of it, where there is room. */
function nameBeside(pen: Pen, name: string, x: number, y: number): void {
  if (detailOf(pen.k) !== "close") return;
  const { g, palette } = pen;
  g.font = `12px ${palette.font}`;
  g.fillStyle = palette["ink-3"];
  g.textAlign = "left";
  g.textBaseline = "middle";
  g.fillText(name, x + 5, y);
}

/** A head on its tripod: a triangle about a dot. */
function drawTransmitters(pen: Pen, model: HallModel): void {
  const { g, palette } = pen;
  const kSide = 6;
  for (const { id, position } of model.transmitters) {
    const p = pen.at(position.x_m, position.y_m);
    g.beginPath();
    for (const [i, turn] of [-90, 30, 150].entries()) {
      const angle = (turn * Math.PI) / 180;
      const [x, y] = [p.x + kSide * Math.cos(angle), p.y + kSide * Math.sin(angle)];
      if (i === 0) g.moveTo(x, y);
      else g.lineTo(x, y);
    }
    g.closePath();
    pen.stroke(palette["map-marker"], 1.25);
    g.beginPath();
    g.arc(p.x, p.y, 1.25, 0, 7);
    pen.fill(palette["map-marker"]);
    nameBeside(pen, id, p.x + kSide, p.y);
  }
}

function drawBrackets(pen: Pen, model: HallModel): void {
  const { g, palette } = pen;
  const far = detailOf(pen.k) === "far";
  for (const station of model.stations) {
    const bracket = model.bracket.get(station.id);
    if (bracket === undefined) continue;
    if (far && !bracket.big) continue;
    const { l, w } = bracket;
    const corner = bracket.big ? 0.85 : 0.45;
    const p = pen.at(station.pose.x_m, station.pose.y_m);
    g.save();
    g.translate(p.x, p.y);
    g.rotate(-station.pose.heading_rad);
    g.scale(pen.k, pen.k);
    g.beginPath();
    for (const [sx, sy] of [
      [-1, -1],
      [-1, 1],
      [1, -1],
      [1, 1],
    ] as const) {
      g.moveTo(sx * l, sy * (w - corner * 0.6));
      g.lineTo(sx * l, sy * w);
      g.lineTo(sx * (l - corner), sy * w);
    }
    const c = bracket.big ? 0.7 : 0.35;
    g.moveTo(-c, 0);
    g.lineTo(c, 0);
    g.moveTo(0, -c);
    g.lineTo(0, c);
    const tip = bracket.big ? l * 0.78 : l * 0.65;
    g.moveTo(tip - c, -c * 0.8);
    g.lineTo(tip, 0);
    g.lineTo(tip - c, c * 0.8);
    g.restore();
    pen.stroke(palette["map-station"], 1.25);
    if (detailOf(pen.k) === "close") {
      // The tolerance at its true size.
      g.save();
      g.translate(p.x, p.y);
      g.rotate(-station.pose.heading_rad);
      g.beginPath();
      const { dx_m, dy_m, shape } = station.tolerance;
      if (shape === "ellipse") g.ellipse(0, 0, dx_m * pen.k, dy_m * pen.k, 0, 0, 7);
      else g.rect(-dx_m * pen.k, -dy_m * pen.k, 2 * dx_m * pen.k, 2 * dy_m * pen.k);
      g.restore();
      pen.stroke(palette["ink-2"], 1);
    }
  }
}

/** An upright cylinder from above: a small full disc in a ring. */
function drawReflectors(pen: Pen, model: HallModel): void {
  const { g, palette } = pen;
  const kRing = 4;
  for (const { id, position } of model.reflectors) {
    const p = pen.at(position.x_m, position.y_m);
    g.beginPath();
    g.arc(p.x, p.y, kRing, 0, 7);
    pen.stroke(palette["map-marker"], 1);
    g.beginPath();
    g.arc(p.x, p.y, 1.75, 0, 7);
    pen.fill(palette["map-marker"]);
    nameBeside(pen, id, p.x + kRing, p.y);
  }
}
