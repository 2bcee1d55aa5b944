import type { Box, MetricPoint } from "@/shared/math/geometry";

/** What part of the hall the canvas shows: `cx`, `cy` in its middle. */
export interface View {
  cx: number;
  cy: number;
  pxPerM: number;
}
export interface Size {
  width: number;
  height: number;
}
export interface ScreenPoint {
  x: number;
  y: number;
}
export interface Margins {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

export const kMinPxPerM = 1;
export const kMaxPxPerM = 400;

export const toScreen = (view: View, size: Size, p: MetricPoint): ScreenPoint => ({
  x: size.width / 2 + (p.x_m - view.cx) * view.pxPerM,
  y: size.height / 2 - (p.y_m - view.cy) * view.pxPerM,
});

export const toHall = (view: View, size: Size, p: ScreenPoint): MetricPoint => ({
  x_m: view.cx + (p.x - size.width / 2) / view.pxPerM,
  y_m: view.cy - (p.y - size.height / 2) / view.pxPerM,
});

/** Zooms so that the hall point under `at` stays under it. */
export function zoomAt(view: View, size: Size, at: ScreenPoint, factor: number): View {
  const pxPerM = Math.min(kMaxPxPerM, Math.max(kMinPxPerM, view.pxPerM * factor));
  const p = toHall(view, size, at);
  return {
    cx: p.x_m - (at.x - size.width / 2) / pxPerM,
    cy: p.y_m + (at.y - size.height / 2) / pxPerM,
    pxPerM,
  };
}

export const panned = (view: View, dx: number, dy: number): View => ({
  ...view,
  cx: view.cx - dx / view.pxPerM,
  cy: view.cy + dy / view.pxPerM,
});

/** The whole box, as large as the canvas allows inside the margins. */
export function fitted(box: Box, size: Size, margins: Margins): View {
  const width = Math.max(1, size.width - margins.left - margins.right);
  const height = Math.max(1, size.height - margins.top - margins.bottom);
  const w = Math.max(0.1, box.maxX - box.minX);
  const h = Math.max(0.1, box.maxY - box.minY);
  const pxPerM = Math.min(kMaxPxPerM, Math.max(kMinPxPerM, Math.min(width / w, height / h)));
  return {
    cx: (box.minX + box.maxX) / 2 + (margins.right - margins.left) / 2 / pxPerM,
    cy: (box.minY + box.maxY) / 2 + (margins.top - margins.bottom) / 2 / pxPerM,
    pxPerM,
  };
}

/** Keeps some of the hall on the canvas, so that nobody gets lost. */
export function kept(view: View, box: Box): View {
  return {
    ...view,
    cx: Math.min(box.maxX, Math.max(box.minX, view.cx)),
    cy: Math.min(box.maxY, Math.max(box.minY, view.cy)),
  };
}

export type Detail = "far" | "middle" | "near" | "close";

export function detailOf(pxPerM: number): Detail {
  if (pxPerM < 8) return "far";
  if (pxPerM < 16) return "middle";
  return pxPerM < 40 ? "near" : "close";
}
