import type { JobOrder, StopRecord, Vehicle } from "@/shared/api/types";
import { haltOf } from "@/shared/live/pause";

/** Where the started move is, read only from what the server holds and the vehicle reported. */
export type MoveProgress =
  | { kind: "stored" }
  | { kind: "assigned" }
  | { kind: "moving"; progress: number; granted: number; expectedAt: string | undefined }
  | { kind: "measuring" }
  | { kind: "held" }
  | { kind: "cancelling" }
  | { kind: "stopping" }
  | { kind: "paused" }
  | { kind: "arrived"; stop: StopRecord | undefined }
  | { kind: "aborted" };

export type Milestone = "requested" | "accepted" | "confirmed" | "arrived";

export function moveProgress(
  order: JobOrder | undefined,
  vehicle: Vehicle | undefined,
  stops: readonly StopRecord[],
): MoveProgress {
  if (!order) return { kind: "stored" };
  const stop = newestStop(order, stops);
  if (order.state === "Ended") return { kind: "arrived", stop };
  if (order.state === "Aborted") return { kind: "aborted" };
  if (order.cancel_requested) return { kind: "cancelling" };
  const own = vehicle && vehicle.order === order.id ? vehicle : undefined;
  const step = order.steps[order.current_step];
  if (own && haltOf(own) === "stopping") return { kind: "stopping" };
  if (own && haltOf(own) === "stands") return { kind: "paused" };
  if (order.state === "Interrupted") return { kind: "held" };
  if (own?.activity === "paused" || own?.pause_confirmed) return { kind: "paused" };
  if (step?.state === "measuring" || own?.activity === "measuring") return { kind: "measuring" };
  if (own?.activity === "blocked") return { kind: "held" };
  if (own?.leg && own.activity === "moving") {
    return {
      kind: "moving",
      progress: clamp01(own.leg.progress),
      granted: grantedShare(own.leg.path, own.leg.granted_points),
      expectedAt: own.leg.expected_at,
    };
  }
  return order.vehicle ? { kind: "assigned" } : { kind: "stored" };
}

/** Milestones passed so far, for the row of four above the bar. */
export function reached(progress: MoveProgress): Milestone[] {
  switch (progress.kind) {
    case "stored":
    case "assigned":
      return ["requested", "accepted"];
    case "moving":
    case "measuring":
    case "held":
    case "cancelling":
    case "stopping":
    case "paused":
      return ["requested", "accepted", "confirmed"];
    case "arrived":
      return ["requested", "accepted", "confirmed", "arrived"];
    case "aborted":
      return ["requested", "accepted"];
  }
}

export function newestStop(order: JobOrder, stops: readonly StopRecord[]): StopRecord | undefined {
  const wanted = order.steps.map((s) => s.stop).filter((id): id is string => !!id);
  const last = wanted[wanted.length - 1];
  const exact = stops.find((s) => s.id === last);
  if (exact) return exact;
  return stops
    .filter((s) => s.order === order.id)
    .reduce<StopRecord | undefined>((best, s) => (!best || s.at > best.at ? s : best), undefined);
}

/** Share of the path length that is released to the vehicle. */
export function grantedShare(path: readonly { x_m: number; y_m: number }[], points: number): number {
  let total = 0;
  let granted = 0;
  for (let i = 1; i < path.length; ++i) {
    const a = path[i - 1];
    const b = path[i];
    if (!a || !b) continue;
    const d = Math.hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    total += d;
    if (i < points) granted += d;
  }
  if (total > 0) return granted / total;
  return points >= path.length ? 1 : 0; // a turn on the spot has no length
}

function clamp01(v: number): number {
  return Math.min(1, Math.max(0, v));
}
