import type { Pose, Vehicle } from "@/shared/api/types";
import { secondsSince } from "@/shared/words/format";
import { useNow } from "./clock";
import { useServerNow } from "./hooks";
import { liveStore } from "./store";

/** Newest pose and the ages of pose and last word, twice a second. */
export interface Heard {
  pose: Pose | undefined;
  speed_mps: number | undefined;
  pose_s: number | undefined;
  heard_s: number | undefined;
}

/** The newer of what the vehicle's record says and what the pose stream brought. */
export function newest(
  vehicle: Vehicle,
  stream: (Pose & { speed_mps: number; age_s: number }) | undefined,
  now_ms: number,
): Heard {
  const record_s = secondsSince(vehicle.pose_at, now_ms);
  const heard_s = secondsSince(vehicle.last_heard_at, now_ms);
  if (
    stream === undefined ||
    !Number.isFinite(stream.age_s) ||
    (record_s !== undefined && record_s <= stream.age_s)
  ) {
    return { pose: vehicle.pose, speed_mps: vehicle.speed_mps, pose_s: record_s, heard_s };
  }
  const { x_m, y_m, heading_rad, speed_mps, age_s } = stream;
  return {
    pose: { x_m, y_m, heading_rad },
    speed_mps,
    pose_s: age_s,
    heard_s: Math.min(age_s, heard_s ?? Infinity),
  };
}

export function useHeard(vehicle: Vehicle): Heard {
  const now = useServerNow(500);
  const { monoMs } = useNow(500);
  const pose = liveStore.poses.get(vehicle.id);
  return newest(vehicle, pose && { ...pose, age_s: Math.max(0, (monoMs - pose.heardAt) / 1000) }, now);
}
