import type { StopRecord } from "@/shared/api/types";

/** What is known of a station's last stop. */
export type LastStop =
  { kind: "known"; stop: StopRecord } | { kind: "none" } | { kind: "loading" } | { kind: "failed" };

/** The newest stop of each station, from however many lists. */
export function newestByStation(...lists: (readonly StopRecord[])[]): Map<string, StopRecord> {
  const newest = new Map<string, StopRecord>();
  for (const stop of lists.flat()) {
    const known = newest.get(stop.station);
    if (known === undefined || stop.at > known.at) newest.set(stop.station, stop);
  }
  return newest;
}
