import type { Leg, Point } from "@/shared/api/types";

/** Farther from its way than this its place along it says nothing. */
const kBeside_m = 3;

/**
 * Share of a drive that lies behind the vehicle. The server counts the nodes it has passed; between two of them
 * the place nearest to the vehicle counts, on the granted part, so that the share does not jump and never goes back.
 */
export function legProgress(leg: Leg, pose: Point | undefined): number {
  const { path, progress } = leg;
  const steps = path.slice(1).map((b, i) => Math.hypot(b.x_m - path[i]!.x_m, b.y_m - path[i]!.y_m));
  const total = steps.reduce((sum, s) => sum + s, 0);
  if (pose === undefined || total === 0) return progress;
  const passed = progress * total;
  let best = kBeside_m;
  let reached = passed;
  let before = 0;
  for (let i = 0; i + 1 < Math.min(path.length, leg.granted_points); i++) {
    const [a, b, length] = [path[i]!, path[i + 1]!, steps[i]!];
    const along =
      ((pose.x_m - a.x_m) * (b.x_m - a.x_m) + (pose.y_m - a.y_m) * (b.y_m - a.y_m)) / (length || 1);
    const s = Math.max(0, Math.min(length, along));
    const share = length === 0 ? 0 : s / length;
    const beside = Math.hypot(
      pose.x_m - a.x_m - share * (b.x_m - a.x_m),
      pose.y_m - a.y_m - share * (b.y_m - a.y_m),
    );
    // Where a way crosses itself the first such place behind the passed nodes counts.
    if (before + s >= passed && beside < best - 1e-6) {
      best = beside;
      reached = before + s;
    }
    before += length;
  }
  return Math.min(1, Math.max(progress, reached / total));
}
