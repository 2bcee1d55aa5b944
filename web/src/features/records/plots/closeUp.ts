import type { StopRecord } from "@/shared/api/types";

/** A picture shows the deviations as large as they fit, or as large as the tolerance is. */
export type Scale = "close" | "tolerance";

/** Half the width of a close-up: the smallest of these that holds what is shown. */
export const kHalves_mm = [1, 2, 5, 10, 25, 50] as const;
export const kHalves_deg = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2] as const;

/** A dot on the very edge would be cut in half. */
const kRoom = 1.05;

/** Of a close-up that shows all within `reach`; undefined where the tolerance's own picture is as close. */
export function closeUpHalf(reach: number, limit: number, halves: readonly number[]): number | undefined {
  const half = halves.find((h) => h >= reach * kRoom);
  return half !== undefined && half < limit ? half : undefined;
}

/** The farthest of this stop and of the earlier ones that count, in mm along either axis. */
export function plotReach_mm(stop: StopRecord, earlier: readonly StopRecord[]): number {
  return 1000 * Math.max(...[stop, ...earlier].flatMap((s) => [Math.abs(s.dx_m), Math.abs(s.dy_m)]));
}

/** Whether a picture begins as a close-up: the tolerance's picture would show all of it in its middle third. */
export function beginsClose(half: number | undefined, limit: number): boolean {
  return half !== undefined && 3 * half <= limit;
}

/** Which sides of the tolerance lie beyond a picture. */
export function beyond(half: number, tol: { x: number; y: number }): "none" | "dx" | "dy" | "both" {
  if (tol.x > half) return tol.y > half ? "both" : "dx";
  return tol.y > half ? "dy" : "none";
}

/** The corner of the picture farthest from the stop, as signs of dx and dy. */
export function emptyCorner(at: { x: number; y: number }): { x: 1 | -1; y: 1 | -1 } {
  return { x: at.x > 0 ? -1 : 1, y: at.y > 0 ? -1 : 1 };
}
