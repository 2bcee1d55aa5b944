import { useInfiniteQuery, useQuery } from "@tanstack/react-query";
import { useMemo } from "react";
import { api, call } from "@/shared/api";
import type { StopRecord } from "@/shared/api/types";
import { useStopRecords } from "@/shared/live";

export interface StopFilter {
  vehicle?: string | undefined;
  station?: number | undefined;
}

const kPage = 50;

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

/** Stops that fit the filter: the newest come with the stream, older ones page by page. */
export function useStopHistory(filter: StopFilter) {
  const live = useStopRecords();
  const { vehicle, station } = filter;
  const pages = useInfiniteQuery({
    queryKey: ["stop-records", vehicle, station],
    initialPageParam: "",
    queryFn: ({ pageParam }) =>
      call(
        api.GET("/api/v1/stop-records", {
          params: {
            query: {
              limit: kPage,
              ...(vehicle !== undefined && { vehicle }),
              ...(station !== undefined && { station }),
              ...(pageParam !== "" && { cursor: pageParam }),
            },
          },
        }),
      ),
    getNextPageParam: (last) => last.next_cursor || undefined,
    staleTime: 60_000,
  });
  const { data } = pages;
  const stops = useMemo(() => {
    const fetched = data?.pages.flatMap((p) => p.items) ?? [];
    return mergeStops(live, fetched).filter((s) => matches(s, { vehicle, station }));
  }, [live, data, vehicle, station]);
  return { stops, pages };
}

/** One stop, from the stream when it is among the newest, else from the server. */
export function useStop(id: string) {
  const live = useStopRecords().find((s) => s.id === id);
  const query = useQuery({
    queryKey: ["stop-record", id],
    queryFn: () => call(api.GET("/api/v1/stop-records/{id}", { params: { path: { id } } })),
    enabled: live === undefined,
    staleTime: Infinity,
    retry: false,
  });
  return { stop: live ?? query.data, query };
}

/** All stops of the order this stop belongs to, first station first. */
export function useRun(stop: StopRecord | undefined) {
  const live = useStopRecords();
  const query = useQuery({
    queryKey: ["stop-records", "order", stop?.order],
    queryFn: () =>
      call(api.GET("/api/v1/stop-records", { params: { query: { order: stop?.order ?? "", limit: 100 } } })),
    enabled: stop !== undefined,
    staleTime: 10_000,
  });
  return useMemo(() => {
    if (!stop) return [];
    const own = live.filter((s) => s.order === stop.order);
    return mergeStops([...own, stop], query.data?.items ?? []).reverse();
  }, [live, query.data, stop]);
}
