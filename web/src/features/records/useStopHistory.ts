import { useInfiniteQuery, useQuery, useQueryClient } from "@tanstack/react-query";
import { useEffect, useMemo, useRef } from "react";
import { api, call } from "@/shared/api";
import type { StopRecord } from "@/shared/api/types";
import { useStopRecords, useUnmeasuredTurn } from "@/shared/live";
import { upTo } from "./plots/statistics";
import { matches, mergeStops, wantsOlder, type StopFilter } from "./stopLists";

const kPage = 50;
/** For the trend of an old stop: larger pages, and an end to the search. */
const kTrendPage = 200;
const kMaxTrendPages = 25;

/** Stops that fit the filter: the newest come with the stream, older ones page by page. */
export function useStopHistory(filter: StopFilter, limit = kPage) {
  const live = useStopRecords();
  const { vehicle, station } = filter;
  const pages = useInfiniteQuery({
    queryKey: ["stop-records", vehicle, station, limit],
    initialPageParam: "",
    queryFn: ({ pageParam }) =>
      call(
        api.GET("/api/v1/stop-records", {
          params: {
            query: {
              limit,
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

/** Stops that were not measured, page by page; asked for again when the stream tells of another one. */
export function useUnmeasuredHistory({ vehicle, station }: StopFilter) {
  const queries = useQueryClient();
  const turn = useUnmeasuredTurn();
  const asked = useRef(turn);
  useEffect(() => {
    if (asked.current === turn) return;
    asked.current = turn;
    void queries.invalidateQueries({ queryKey: ["unmeasured-stops"] });
  }, [queries, turn]);
  const pages = useInfiniteQuery({
    queryKey: ["unmeasured-stops", vehicle, station],
    initialPageParam: "",
    queryFn: ({ pageParam }) =>
      call(
        api.GET("/api/v1/unmeasured-stops", {
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
  const events = useMemo(() => pages.data?.pages.flatMap((p) => p.items) ?? [], [pages.data]);
  return { events, pages };
}

/** This stop and those of its vehicle before it, oldest first; asks for older pages until there are `count`. */
export function useStopsUpTo(stop: StopRecord, count: number) {
  const { stops, pages } = useStopHistory({ vehicle: stop.vehicle }, kTrendPage);
  const { fetchNextPage, hasNextPage, isFetching, isError } = pages;
  const fetched = pages.data?.pages.length ?? 0;
  const more =
    hasNextPage && !isFetching && !isError && fetched < kMaxTrendPages && wantsOlder(stops, stop, count);
  useEffect(() => {
    if (more) void fetchNextPage();
  }, [more, fetchNextPage]);
  const last = useMemo(() => upTo(stops, stop, count), [stops, stop, count]);
  return { last, failed: isError };
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
    return mergeStops(
      [...own, stop],
      (query.data?.items ?? []).filter((s) => s.order === stop.order),
    ).reverse();
  }, [live, query.data, stop]);
}
