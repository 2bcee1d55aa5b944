import type { FleetEvent, StopRecord } from "@/shared/api/types";
import { upTo } from "./plots/statistics";

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

/** A stop of the list: one with a record, or one that could not be measured. */
export type ListedStop = { at: string; record: StopRecord } | { at: string; unmeasured: FleetEvent };

/** How a stop came out, besides inside its tolerance. */
export const kResults = ["outside", "unmeasured"] as const;

export function resultOf(stop: ListedStop): (typeof kResults)[number] | undefined {
  if ("unmeasured" in stop) return "unmeasured";
  return stop.record.inside ? undefined : "outside";
}

/**
 * Both kinds as one list, newest first. Each comes page by page: what is older than the end of the pages of one kind is
 * left out until its next page is there, so that no row appears above one that has been read.
 */
export function listedStops(
  records: { items: readonly StopRecord[]; more: boolean },
  unmeasured: { items: readonly FleetEvent[]; more: boolean },
): ListedStop[] {
  const ends = [records, unmeasured].flatMap(({ items, more }) => (more ? (items.at(-1)?.at ?? []) : []));
  const end = ends.reduce((latest, at) => (at > latest ? at : latest), "");
  const all: ListedStop[] = [
    ...records.items.map((record) => ({ at: record.at, record })),
    ...unmeasured.items.map((event) => ({ at: event.at, unmeasured: event })),
  ];
  return all.filter((stop) => stop.at >= end).sort((a, b) => (a.at < b.at ? 1 : a.at > b.at ? -1 : 0));
}
