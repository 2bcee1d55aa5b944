import { boxOf, type MetricPoint } from "@/shared/math/geometry";
import type { Pen } from "./pen";
import type { Dimension, HallModel, MapOverlays } from "./scene";

// A move that is looked at before it is begun: what it sweeps below the vehicles, its way and end above them.

/** What each way to drive would sweep: the chosen one hatched, the others as outlines. */
export function drawSwept(pen: Pen, { areas = [] }: MapOverlays): void {
  const { palette, g } = pen;
  for (const { rings, look, dash } of areas) {
    const outline = () => {
      g.beginPath();
      for (const ring of rings) pen.path(ring, true, false);
    };
    if (look === "chosen") {
      outline();
      pen.hatch(palette["swept-hatch"], 8, 1.5);
      outline();
      pen.stroke(palette.swept, 1.5, [7, 4]);
    } else {
      outline();
      if (look === "looked") pen.fill(palette["grant-fill"]);
      pen.stroke(look === "looked" ? palette.swept : palette["ink-3"], look === "looked" ? 2.5 : 1.5, dash);
    }
  }
}

export function drawMove(pen: Pen, model: HallModel, overlays: MapOverlays): void {
  drawGhost(pen, model, overlays);
  const { palette, g } = pen;
  if (overlays.path !== undefined && overlays.path.length > 1) {
    pen.path(overlays.path, false);
    pen.stroke(palette.swept, 2, [6, 5]);
  }
  for (const mark of overlays.marks ?? []) {
    const p = pen.at(mark.x_m, mark.y_m);
    g.beginPath();
    g.arc(p.x, p.y, 7, 0, 7);
    g.moveTo(p.x - 11, p.y);
    g.lineTo(p.x + 11, p.y);
    g.moveTo(p.x, p.y - 11);
    g.lineTo(p.x, p.y + 11);
    pen.stroke(palette.ink, 1.5);
  }
  if (overlays.dimension !== undefined) drawDimension(pen, overlays.dimension);
  if (overlays.clearance !== undefined) drawDimension(pen, overlays.clearance);
  if (overlays.turn !== undefined && overlays.turn.points.length > 1) drawTurn(pen, overlays.turn);
}

export function arrowHead(
  pen: Pen,
  path: readonly MetricPoint[],
  size: number,
  filled: boolean,
  colour: string,
): void {
  const end = path[path.length - 1];
  if (end === undefined) return;
  const e = pen.at(end.x_m, end.y_m);
  // Direction over the last few pixels, so that a short last piece does not turn the head.
  let from: { x: number; y: number } | undefined;
  for (let i = path.length - 2; i >= 0; i--) {
    from = pen.at(path[i]!.x_m, path[i]!.y_m);
    if (Math.hypot(e.x - from.x, e.y - from.y) > size) break;
  }
  if (from === undefined || Math.hypot(e.x - from.x, e.y - from.y) < 1) return;
  const a = Math.atan2(e.y - from.y, e.x - from.x);
  const { g } = pen;
  g.beginPath();
  g.moveTo(e.x + size * 0.6 * Math.cos(a), e.y + size * 0.6 * Math.sin(a));
  for (const turn of [2.4, -2.4]) g.lineTo(e.x + size * Math.cos(a + turn), e.y + size * Math.sin(a + turn));
  g.closePath();
  if (filled) pen.fill(colour);
  else {
    pen.fill(pen.palette["map-floor"]);
    pen.stroke(colour, 1.5);
  }
}

function drawDimension(pen: Pen, { from, to, extensions, text }: Dimension): void {
  const { palette } = pen;
  for (const line of [...extensions, [from, to]]) {
    pen.path(line, false);
    pen.stroke(palette["ink-3"], 1);
  }
  arrowHead(pen, [from, to], 9, true, palette["ink-3"]);
  arrowHead(pen, [to, from], 9, true, palette["ink-3"]);
  const middle = pen.at((from.x_m + to.x_m) / 2, (from.y_m + to.y_m) / 2);
  words(pen, text, middle, palette.ink);
}

function drawTurn(pen: Pen, { points, text }: NonNullable<MapOverlays["turn"]>): void {
  const { palette } = pen;
  pen.path(points, false);
  pen.stroke(palette.swept, 2);
  arrowHead(pen, points, 11, true, palette.swept);
  const mid = points[Math.floor(points.length / 2)]!;
  words(pen, text, pen.at(mid.x_m, mid.y_m), palette.swept);
}

/** A figure on the drawing, on a patch of floor so that no line runs through it. */
function words(pen: Pen, text: string, at: { x: number; y: number }, ink: string): void {
  const { g, palette } = pen;
  g.font = `700 14px ${palette.font}`;
  const width = g.measureText(text).width + 8;
  g.beginPath();
  g.roundRect(at.x - width / 2, at.y - 10, width, 20, 3);
  pen.fill(palette["map-floor"]);
  g.fillStyle = ink;
  g.textAlign = "center";
  g.textBaseline = "middle";
  g.fillText(text, at.x, at.y + 0.5);
}

function drawGhost(pen: Pen, model: HallModel, overlays: MapOverlays): void {
  if (overlays.ghost === undefined) return;
  const { pose, loaded } = overlays.ghost;
  const type = model.types.get(overlays.ghost.type);
  if (type === undefined) return;
  if (loaded && type.load_footprint.length > 2) {
    pen.body(type.load_footprint, pose);
    pen.stroke(pen.palette.swept, 1.25);
  }
  const box = boxOf(type.footprint);
  const c = Math.min(0.7, (box.maxY - box.minY) * 0.28);
  pen.body(type.footprint, pose);
  pen.stroke(pen.palette.swept, 2);
  const tip = box.maxX - 0.3 * c;
  const { g } = pen;
  const p = pen.at(pose.x_m, pose.y_m);
  g.save();
  g.translate(p.x, p.y);
  g.rotate(-pose.heading_rad);
  g.beginPath();
  g.moveTo((tip - 1.4 * c) * pen.k, -c * pen.k);
  g.lineTo(tip * pen.k, 0);
  g.lineTo((tip - 1.4 * c) * pen.k, c * pen.k);
  g.restore();
  pen.stroke(pen.palette.swept, 2);
}
