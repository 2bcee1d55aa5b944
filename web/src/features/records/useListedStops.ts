import { listedStops, type StopFilter } from "./stopLists";
import { useStopHistory, useUnmeasuredHistory } from "./useStopHistory";

/** Stops with and without a record that fit the filter, as far as both have been loaded. */
export function useListedStops(filter: StopFilter) {
  const records = useStopHistory(filter);
  const unmeasured = useUnmeasuredHistory(filter);
  const pages = [records.pages, unmeasured.pages];
  return {
    stops: listedStops(
      { items: records.stops, more: records.pages.hasNextPage },
      { items: unmeasured.events, more: unmeasured.pages.hasNextPage },
    ),
    pending: pages.some((p) => p.isPending),
    failed: pages.find((p) => p.isError),
    loadingOlder: pages.some((p) => p.isFetchingNextPage),
    hasOlder: pages.some((p) => p.hasNextPage),
    older: () => {
      for (const p of pages) if (p.hasNextPage) void p.fetchNextPage();
    },
    again: () => {
      for (const p of pages) if (p.isError) void (p.isFetchNextPageError ? p.fetchNextPage() : p.refetch());
    },
  };
}
