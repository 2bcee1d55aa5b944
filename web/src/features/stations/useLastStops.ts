import { useQueries, useQuery } from "@tanstack/react-query";
import { api, call } from "@/shared/api";
import { useStopRecords, type LiveStation } from "@/shared/live";
import { newestByStation, type LastStop } from "./lastStops";

/** Newest stops asked for at once; only stations that are not among them are asked for one by one. */
const kPage = 500;
const kStale_ms = 60_000;

/** The last stop of every station. The stream brings the newest 50 of all, so older ones are fetched. */
export function useLastStops(stations: readonly LiveStation[]): (station: LiveStation) => LastStop {
  const live = useStopRecords();
  const page = useQuery({
    queryKey: ["stop-records", "newest", kPage],
    queryFn: () => call(api.GET("/api/v1/stop-records", { params: { query: { limit: kPage } } })),
    staleTime: kStale_ms,
  });
  const recent = newestByStation(live, page.data?.items ?? []);
  const older = page.data?.next_cursor ? stations.filter((s) => !recent.has(s.id)) : [];
  const single = useQueries({
    queries: older.map((s) => ({
      queryKey: ["stop-records", "newest-of", s.number],
      queryFn: () =>
        call(api.GET("/api/v1/stop-records", { params: { query: { station: s.number, limit: 1 } } })),
      staleTime: kStale_ms,
    })),
  });
  const singleOf = new Map(older.map((s, i) => [s.id, single[i]]));
  return (station) => {
    const query = singleOf.get(station.id);
    const stop = recent.get(station.id) ?? query?.data?.items[0];
    if (stop) return { kind: "known", stop };
    if (page.isError || query?.isError) return { kind: "failed" };
    return page.isPending || query?.isPending ? { kind: "loading" } : { kind: "none" };
  };
}
