import type { StopRecord } from "@/shared/api/types";
import { upTo } from "./statistics";

export interface StopFilter {
  vehicle?: string | undefined;
  station?: number | undefined;
}

export function matches(stop: StopRecord, filter: StopFilter): boolean {
  return (
    (filter.vehicle === undefined || stop.vehicle === filter.vehicle) &&
    (filter.station === undefined || stop.number === filter.station)
  );
}

/** Live records and fetched pages as one list, newest first, each once. */
export function mergeStops(live: readonly StopRecord[], pages: readonly StopRecord[]): StopRecord[] {
  const byId = new Map<string, StopRecord>();
  for (const stop of [...pages, ...live]) byId.set(stop.id, stop);
  return [...byId.values()].sort((a, b) => (a.at < b.at ? 1 : a.at > b.at ? -1 : a.id < b.id ? 1 : -1));
}

/** Whether the stops before `current` do not yet make `count`, itself counted: then an older page is wanted. */
export function wantsOlder(stops: readonly StopRecord[], current: StopRecord, count: number): boolean {
  return upTo(stops, current, count).length < count;
}
