import type { Vehicle } from "@/shared/api/types";
import { inHand, silent } from "@/shared/live";

export type ResumeGroup = "fleet" | "waits" | "singly";
export interface ResumeRows {
  group: ResumeGroup;
  vehicles: readonly Vehicle[];
}

/** Who may be let go, by why it stands. One that was paused by itself has its own reason to stand. */
function groupOf(v: Vehicle): ResumeGroup | undefined {
  if (v.paused) return v.pause?.with_fleet ? "fleet" : "singly";
  return v.needs_resume && !inHand(v) ? "waits" : undefined;
}

const kGroups: readonly ResumeGroup[] = ["fleet", "waits", "singly"];

export function resumeGroups(vehicles: readonly Vehicle[]): ResumeRows[] {
  return kGroups
    .map((group) => ({ group, vehicles: vehicles.filter((v) => groupOf(v) === group) }))
    .filter((rows) => rows.vehicles.length > 0);
}

/** Ticked when the panel opens: never who was paused singly, nor who cannot hear. */
export const tickedAtFirst = (v: Vehicle) => groupOf(v) !== "singly" && !silent(v);
