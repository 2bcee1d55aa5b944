import type { SymbolName } from "@/shared/ui/Icon";
import type { Palette } from "./palette";

/** Status shapes for the canvas, in an 18 x 18 box: filled parts and stroked parts. */
const kShapes: Partial<
  Record<SymbolName, { fill?: string; stroke?: string; width?: number; dash?: number[] }>
> = {
  "s-moving": { fill: "M4 2.5L15 9L4 15.5Z" },
  "s-stand": { fill: "M3.5 3.5H14.5V14.5H3.5Z" },
  "s-feet": { fill: "M3 3H15V11H3Z", stroke: "M2 15.5H6.5M11.5 15.5H16M4.2 11V15M13.8 11V15", width: 2 },
  "s-wait": { stroke: "M4 2.2H14M4 15.8H14M5.2 2.5V5L12.8 13V15.5M12.8 2.5V5L5.2 13V15.5", width: 1.8 },
  "s-charge": { fill: "M10.5 1.5L4 10.2H8.4L7.4 16.5L14 7.6H9.6Z" },
  "s-stale": { stroke: "M16 9A7 7 0 1 1 2 9A7 7 0 1 1 16 9M9 5.2V9L11.6 10.6", width: 1.8 },
  "s-measure": { stroke: "M14 9A5 5 0 1 1 4 9A5 5 0 1 1 14 9M9 1V6M9 12V17M1 9H6M12 9H17", width: 1.8 },
  "a-1": { fill: "M9 .8L17.2 9L9 17.2L.8 9Z" },
  "a-2": { fill: "M9 1.4L17.2 16.2H.8Z" },
};
const paths = new Map<string, Path2D>();
function pathOf(d: string): Path2D {
  const known = paths.get(d);
  if (known !== undefined) return known;
  const path = new Path2D(d);
  paths.set(d, path);
  return path;
}

export interface VehicleTag {
  name: string;
  extra: string;
  symbol: SymbolName;
  look: "plain" | "selected" | "high" | "critical" | "stale";
  /** Far out: the name alone. */
  compact: boolean;
}

const kBold = 700;
const kTagHeight = 24;
const kCompactHeight = 17;

export function vehicleTagSize(
  g: CanvasRenderingContext2D,
  tag: VehicleTag,
  palette: Palette,
): { width: number; height: number } {
  g.font = `${kBold} 13px ${palette.font}`;
  const name = g.measureText(tag.name).width;
  if (tag.compact) return { width: Math.ceil(name) + 6, height: kCompactHeight };
  let width = 5 + 14 + 4 + name + 8;
  if (tag.extra !== "") {
    g.font = `13px ${palette.font}`;
    width += 4 + g.measureText(tag.extra).width;
  }
  return { width: Math.ceil(width), height: kTagHeight };
}

export function drawVehicleTag(
  g: CanvasRenderingContext2D,
  tag: VehicleTag,
  at: { x: number; y: number },
  { width, height: h }: { width: number; height: number },
  p: Palette,
): void {
  const looks = {
    plain: [p.surface, p["rule-2"], p.ink, 1],
    stale: [p.surface, p["ink-2"], p.ink, 1.5],
    selected: [p.accent, p.accent, p["on-accent"], 1],
    high: [p["high-fill"], p["high-edge"], p["on-high"], 1],
    critical: [p["critical-fill"], p.critical, p["on-critical"], 1],
  } as const;
  const [fill, line, ink, lineWidth] = looks[tag.look];
  const x = Math.round(at.x - width / 2) + 0.5;
  const y = Math.round(at.y - h / 2) + 0.5;
  g.beginPath();
  g.roundRect(x, y, width, h, h / 2);
  g.fillStyle = fill;
  g.fill();
  g.setLineDash(tag.look === "stale" ? [4, 3] : []);
  g.strokeStyle = line;
  g.lineWidth = lineWidth;
  g.stroke();
  g.setLineDash([]);
  if (tag.compact) {
    g.fillStyle = ink;
    g.textAlign = "center";
    g.textBaseline = "middle";
    g.font = `${kBold} 13px ${p.font}`;
    g.fillText(tag.name, x + width / 2, y + h / 2 + 0.5);
    return;
  }
  const shape = kShapes[tag.symbol];
  g.save();
  g.translate(x + 7, y + 5);
  g.scale(14 / 18, 14 / 18);
  g.fillStyle = ink;
  g.strokeStyle = ink;
  if (shape?.fill !== undefined) g.fill(pathOf(shape.fill));
  if (shape?.stroke !== undefined) {
    g.lineWidth = shape.width ?? 2;
    g.stroke(pathOf(shape.stroke));
  }
  if (tag.symbol === "a-1" || tag.symbol === "a-2") {
    g.strokeStyle = fill;
    g.lineWidth = 2;
    g.stroke(pathOf("M9 6.2V11M9 12.4V14.2"));
  }
  g.restore();
  g.fillStyle = ink;
  g.textAlign = "left";
  g.textBaseline = "middle";
  g.font = `${kBold} 13px ${p.font}`;
  const nameAt = x + 7 + 14 + 3;
  g.fillText(tag.name, nameAt, y + h / 2 + 0.5);
  if (tag.extra === "") return;
  const nameWidth = g.measureText(tag.name).width;
  g.font = `13px ${p.font}`;
  g.fillText(tag.extra, nameAt + nameWidth + 4, y + h / 2 + 0.5);
}

export interface StationTag {
  number: string;
  /** "off": not for the vehicle that is being sent. */
  look: "free" | "occupied" | "reserved" | "goal" | "bare" | "off";
  big: boolean;
}

export function stationTagSize(
  g: CanvasRenderingContext2D,
  tag: StationTag,
  palette: Palette,
  narrow: boolean,
) {
  const font = tag.big ? (narrow ? 14 : 16) : 13;
  g.font = `${kBold} ${font}px ${palette.font}`;
  const min = tag.big ? (narrow ? 24 : 28) : narrow ? 20 : 22;
  const height = tag.big ? (narrow ? 22 : 26) : narrow ? 18 : 20;
  return { width: Math.max(min, Math.ceil(g.measureText(tag.number).width) + 8), height, font };
}

export function drawStationTag(
  g: CanvasRenderingContext2D,
  tag: StationTag,
  at: { x: number; y: number },
  size: { width: number; height: number; font: number },
  p: Palette,
): void {
  const x = Math.round(at.x - size.width / 2) + 0.5;
  const y = Math.round(at.y - size.height / 2) + 0.5;
  g.font = `${kBold} ${size.font}px ${p.font}`;
  g.textAlign = "center";
  g.textBaseline = "middle";
  const middle = { x: x + size.width / 2, y: y + size.height / 2 + 1 };
  if (tag.look === "bare" || tag.look === "off") {
    g.strokeStyle = p["map-tag"];
    g.lineWidth = 3;
    g.strokeText(tag.number, middle.x, middle.y);
    g.fillStyle = tag.look === "off" ? p["map-route"] : p["map-tag-ink"];
    g.font = `${tag.look === "off" ? 400 : kBold} ${size.font}px ${p.font}`;
    g.fillText(tag.number, middle.x, middle.y);
    return;
  }
  g.beginPath();
  g.roundRect(x, y, size.width, size.height, 2);
  g.fillStyle = tag.look === "occupied" ? p["map-station"] : tag.look === "goal" ? p.surface : p["map-tag"];
  g.fill();
  g.setLineDash(tag.look === "reserved" ? [4, 3] : []);
  g.strokeStyle = tag.look === "goal" ? p.accent : p["map-station"];
  g.lineWidth = tag.look === "goal" ? 2 : tag.look === "reserved" ? 1.5 : 1;
  g.stroke();
  g.setLineDash([]);
  g.fillStyle = tag.look === "occupied" ? p["map-floor"] : tag.look === "goal" ? p.accent : p["map-tag-ink"];
  g.fillText(tag.number, middle.x, middle.y);
}
