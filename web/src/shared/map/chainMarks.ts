import type { MarkerChain, Point } from "@/shared/api/types";

/** A code on the floor that a drive relies on, or the place where one is missing. */
export interface ChainMark {
  kind: "segment" | "boundary" | "missing";
  place: Point;
}

/** What of a drive's marker chain is drawn on the floor. */
export function chainMarks(chain: MarkerChain | undefined): ChainMark[] {
  if (chain === undefined) return [];
  const marks = chain.markers.map((m): ChainMark => ({
    kind: m.marker === chain.boundary ? "boundary" : "segment",
    place: m.place,
  }));
  const { x_m, y_m } = chain.reason?.params ?? {};
  if (typeof x_m === "number" && typeof y_m === "number")
    marks.push({ kind: "missing", place: { x_m, y_m } });
  return marks;
}
