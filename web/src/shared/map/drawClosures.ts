import type { Closure, Point } from "@/shared/api/types";
import type { Pen } from "./pen";
import type { MapWords } from "./renderer";
import type { HallModel, Lane, MapOverlays } from "./scene";

/** A closed lane is barred between its nodes; who stands at one of them is not on it. */
const kLaneEndShare = 0.12;

function barred(lane: Lane): [Point, Point] {
  const at = (t: number) => ({
    x_m: lane.ax + t * (lane.bx - lane.ax),
    y_m: lane.ay + t * (lane.by - lane.ay),
  });
  return [at(kLaneEndShare), at(1 - kLaneEndShare)];
}

type Shape = Pick<Closure, "outline" | "edges">;

export function lanesOf(model: HallModel, closure: Shape): readonly Lane[] {
  return model.lanes.filter((lane) => lane.edges.some((edge) => closure.edges.includes(edge)));
}

/** Where a closure's name stands: the middle of its area, or of its first lane. */
export function closurePlace(model: HallModel, closure: Closure): Point | undefined {
  if (closure.outline !== undefined && closure.outline.length > 2) {
    if (closure.hall !== undefined && closure.hall !== model.hall.id) return undefined;
    const xs = closure.outline.map((p) => p.x_m);
    const ys = closure.outline.map((p) => p.y_m);
    return { x_m: (Math.min(...xs) + Math.max(...xs)) / 2, y_m: (Math.min(...ys) + Math.max(...ys)) / 2 };
  }
  const [lane] = lanesOf(model, closure);
  return lane && { x_m: (lane.ax + lane.bx) / 2, y_m: (lane.ay + lane.by) / 2 };
}

/** Closed floor: dots inside a strong line, lanes as a barred strip. Never by colour alone. */
export function drawClosures(
  pen: Pen,
  model: HallModel,
  closures: readonly Closure[],
  overlays: MapOverlays,
  words: Pick<MapWords, "closure">,
): void {
  const { palette } = pen;
  for (const closure of closures) {
    if (closurePlace(model, closure) !== undefined) drawShape(pen, model, closure, palette["ink-2"]);
  }
  for (const closure of closures) drawName(pen, model, closure, words.closure(closure.name));
  const { closing } = overlays;
  if (closing === undefined) return;
  drawShape(pen, model, closing, palette.accent);
  if (closing.corner === undefined) return;
  const p = pen.at(closing.corner.x_m, closing.corner.y_m);
  pen.g.beginPath();
  pen.g.rect(p.x - 6, p.y - 6, 12, 12);
  pen.stroke(palette.accent, 2);
}

function drawShape(pen: Pen, model: HallModel, shape: Shape, ink: string): void {
  const { g } = pen;
  if (shape.outline !== undefined && shape.outline.length > 2) {
    pen.path(shape.outline, true);
    pen.fill(pen.palette["map-zone"], 0.8);
    pen.path(shape.outline, true);
    pen.dots(ink, 9, 1.5);
    pen.path(shape.outline, true);
    pen.stroke(ink, 2.5);
  }
  for (const lane of lanesOf(model, shape)) {
    const [from, to] = barred(lane);
    const a = pen.at(from.x_m, from.y_m);
    const b = pen.at(to.x_m, to.y_m);
    const length = Math.hypot(b.x - a.x, b.y - a.y);
    if (length < 1) continue;
    const half = Math.max(5, Math.min(14, 0.8 * pen.k));
    const u = { x: (b.x - a.x) / length, y: (b.y - a.y) / length };
    g.beginPath();
    g.moveTo(a.x - u.y * half, a.y + u.x * half);
    g.lineTo(b.x - u.y * half, b.y + u.x * half);
    g.lineTo(b.x + u.y * half, b.y - u.x * half);
    g.lineTo(a.x + u.y * half, a.y - u.x * half);
    g.closePath();
    pen.fill(pen.palette["map-zone"]);
    pen.stroke(ink, 2);
    g.beginPath();
    const step = 2 * half;
    for (let s = half; s < length; s += step) {
      const c = { x: a.x + u.x * s, y: a.y + u.y * s };
      g.moveTo(c.x - u.x * half * 0.6 - u.y * half, c.y - u.y * half * 0.6 + u.x * half);
      g.lineTo(c.x + u.x * half * 0.6 + u.y * half, c.y + u.y * half * 0.6 - u.x * half);
    }
    pen.stroke(ink, 2);
  }
}

/** The name with a bar through a circle, on the floor: vehicles and their tags lie above it. */
function drawName(pen: Pen, model: HallModel, closure: Closure, name: string): void {
  const place = closurePlace(model, closure);
  if (place === undefined) return;
  const { g, palette } = pen;
  g.font = `700 13px ${palette.font}`;
  const width = g.measureText(name).width + 30;
  const p = pen.at(place.x_m, place.y_m);
  const [x, y] = [Math.round(p.x - width / 2) + 0.5, Math.round(p.y - 11) + 0.5];
  g.beginPath();
  g.roundRect(x, y, width, 22, 3);
  pen.fill(palette.surface);
  pen.stroke(palette["ink-2"], 1.5);
  g.beginPath();
  g.arc(x + 13, y + 11, 6, 0, 7);
  g.moveTo(x + 9, y + 11);
  g.lineTo(x + 17, y + 11);
  pen.stroke(palette.ink, 2);
  g.fillStyle = palette.ink;
  g.textAlign = "left";
  g.textBaseline = "middle";
  g.fillText(name, x + 24, y + 11.5);
}
