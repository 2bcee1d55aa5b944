import type { Vehicle } from "@/shared/api/types";
import { alarmOf, groupOf, kGroups, type Priority } from "@/shared/live/attention";

const kRank: Record<Priority, number> = { critical: 0, high: 1, low: 2 };

/** The most urgent first: what needs somebody, then what waits, moves, stands; within these by name. */
export function byUrgency(vehicles: readonly Vehicle[], nowMs: number): Vehicle[] {
  const rank = (v: Vehicle) => {
    const alarm = alarmOf(v, nowMs);
    return alarm === undefined ? kGroups.indexOf(groupOf(v)) + 2 : kRank[alarm.priority];
  };
  return vehicles
    .map((v) => ({ v, rank: rank(v) }))
    .sort((a, b) => a.rank - b.rank || a.v.name.localeCompare(b.v.name, "en", { numeric: true }))
    .map(({ v }) => v);
}
