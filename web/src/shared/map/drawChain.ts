import type { MarkerChain } from "@/shared/api/types";
import { chainMarks } from "./chainMarks";
import type { Pen } from "./pen";

const kRingPx = 8;
const kBoundaryPx = 12;
const kCrossPx = 5;

/** Codes that a drive relies on, under way or looked at before it is sent: a ring each, two about the boundary marker; a
 * cross in a dashed ring where one is missing. */
export function drawChain(pen: Pen, chain: MarkerChain | undefined): void {
  const { g, palette } = pen;
  const ring = (x: number, y: number, radius: number, dash: readonly number[] = []) => {
    g.beginPath();
    g.arc(x, y, radius, 0, 7);
    pen.stroke(dash.length > 0 ? palette["high-edge"] : palette.accent, 2, dash);
  };
  for (const { kind, place } of chainMarks(chain)) {
    const { x, y } = pen.at(place.x_m, place.y_m);
    ring(x, y, kRingPx, kind === "missing" ? [3, 3] : []);
    if (kind === "boundary") ring(x, y, kBoundaryPx);
    if (kind !== "missing") continue;
    g.beginPath();
    g.moveTo(x - kCrossPx, y);
    g.lineTo(x + kCrossPx, y);
    g.moveTo(x, y - kCrossPx);
    g.lineTo(x, y + kCrossPx);
    pen.stroke(palette["high-edge"], 2);
  }
}
