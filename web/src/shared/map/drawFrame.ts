import type { Pen } from "./pen";
import type { HallModel } from "./scene";
import { fixed } from "@/shared/words/format";

/** Rulers along the hall's edges (or the canvas's, when those are out of sight), scale bar and north arrow. */
export function drawRulers(pen: Pen, model: HallModel, north: string): void {
  const { g, palette, size } = pen;
  const { box } = model;
  const strip = 26;
  const corner = pen.at(box.minX, box.maxY);
  const wall = Math.max(3, 0.6 * pen.k);
  const y = Math.max(strip, corner.y - wall - 5);
  const x = Math.max(strip + 12, corner.x - wall - 5);
  g.fillStyle = palette["map-out"];
  if (y === strip) g.fillRect(0, 0, size.width, strip + 1);
  if (x === strip + 12) g.fillRect(0, 0, strip + 13, size.height);
  const major = [1, 2, 5, 10, 20, 50].find((step) => step * pen.k >= 52) ?? 100;
  const minor = major >= 10 ? major / 10 : major / 5;
  const fine = minor * pen.k >= 5;
  g.font = `12px ${palette.font}`;
  g.fillStyle = palette["ink-3"];
  const left = pen.at(box.minX, 0).x;
  const right = pen.at(box.maxX, 0).x;
  const top = pen.at(0, box.maxY).y;
  const bottom = pen.at(0, box.minY).y;
  g.beginPath();
  g.moveTo(Math.max(x, left), y + 0.5);
  g.lineTo(Math.min(size.width, right), y + 0.5);
  g.moveTo(x + 0.5, Math.max(y, top));
  g.lineTo(x + 0.5, Math.min(size.height, bottom));
  const ticks = (from: number, to: number, put: (v: number, length: number, text: boolean) => void) => {
    const count = Math.floor((to - from) / minor + 1e-6);
    for (let i = 0; i <= count; i++) {
      const v = from + i * minor;
      const isMajor = Math.abs(v / major - Math.round(v / major)) < 1e-6;
      const isHalf = Math.abs((v * 2) / major - Math.round((v * 2) / major)) < 1e-6;
      if (!fine && !isMajor) continue;
      put(v, isMajor ? 11 : isHalf ? 7 : 4, isMajor);
    }
  };
  const decimals = major < 1 ? 1 : 0;
  g.textAlign = "center";
  g.textBaseline = "alphabetic";
  ticks(Math.ceil(box.minX / major) * major, box.maxX, (v, length, text) => {
    const s = Math.round(pen.at(v, 0).x) + 0.5;
    if (s < x || s > size.width) return;
    g.moveTo(s, y);
    g.lineTo(s, y - length);
    if (text) g.fillText(fixed(v, decimals), s, y - 13);
  });
  g.textAlign = "right";
  g.textBaseline = "middle";
  ticks(Math.ceil(box.minY / major) * major, box.maxY, (v, length, text) => {
    const s = Math.round(pen.at(0, v).y) + 0.5;
    if (s < y || s > size.height) return;
    g.moveTo(x, s);
    g.lineTo(x - length, s);
    if (text) g.fillText(fixed(v, decimals), x - 14, s);
  });
  pen.stroke(palette["map-rule"], 1);
  drawScale(pen, major, north);
}

function drawScale(pen: Pen, step: number, north: string): void {
  const { g, palette, size } = pen;
  const length = step * pen.k;
  const y = size.height - 13;
  const right = size.width - 52;
  const left = right - length;
  const text = step < 1 ? `${fixed(step * 1000, 0)} mm` : `${step} m`;
  g.font = `12px ${palette.font}`;
  const width = g.measureText(text).width;
  g.fillStyle = palette["map-out"];
  g.fillRect(left - width - 18, y - 12, length + width + 70, 25);
  g.beginPath();
  g.moveTo(left, y);
  g.lineTo(right, y);
  for (const x of [left, (left + right) / 2, right]) {
    g.moveTo(x, y - 4);
    g.lineTo(x, y + 4);
  }
  g.moveTo(size.width - 34.5, y + 6);
  g.lineTo(size.width - 34.5, y - 4);
  pen.stroke(palette["map-rule"], 1);
  g.fillStyle = palette["map-wall"];
  g.fillRect(left, y - 1.5, length / 2, 3);
  g.beginPath();
  g.moveTo(size.width - 34.5, y - 9);
  g.lineTo(size.width - 39.5, y);
  g.lineTo(size.width - 29.5, y);
  pen.fill(palette["map-wall"]);
  g.fillStyle = palette["ink-3"];
  g.textBaseline = "middle";
  g.textAlign = "right";
  g.fillText(text, left - 8, y);
  g.textAlign = "left";
  g.fillText(north, size.width - 24, y);
}
