import { useInfiniteQuery, useQuery } from "@tanstack/react-query";
import { useMemo } from "react";
import { api, call } from "@/shared/api";
import type { JobOrder, StopRecord } from "@/shared/api/types";
import { useJobOrder, useJobOrders, useStopRecords } from "@/shared/live";
import { mergeOrders } from "./orderLook";

const kPage = 50;

/** Open and newest orders from the stream; older ones page by page when asked for. */
export function useOrders() {
  const live = useJobOrders();
  const older = useInfiniteQuery({
    queryKey: ["job-orders"],
    initialPageParam: "",
    queryFn: ({ pageParam }) =>
      call(
        api.GET("/api/v1/job-orders", {
          params: { query: { limit: kPage, ...(pageParam !== "" && { cursor: pageParam }) } },
        }),
      ),
    getNextPageParam: (last) => last.next_cursor || undefined,
    staleTime: 60_000,
  });
  const { data } = older;
  const orders = useMemo(() => mergeOrders(live, data?.pages.flatMap((p) => p.items) ?? []), [live, data]);
  return { orders, older };
}

export function useOrder(id: string) {
  const live = useJobOrder(id);
  const query = useQuery({
    queryKey: ["job-order", id],
    queryFn: () => call(api.GET("/api/v1/job-orders/{id}", { params: { path: { id } } })),
    enabled: live === undefined,
    staleTime: 10_000,
    retry: false,
  });
  return { order: live ?? query.data, query };
}

/** The measured stops of an order by their ids. The stream has the newest only; an older order's are asked for once. */
export function useOrderStops(order: JobOrder): ReadonlyMap<string, StopRecord> {
  const live = useStopRecords();
  const own = useMemo(() => live.filter((stop) => stop.order === order.id), [live, order.id]);
  const missing = order.steps.some((step) => step.stop && !own.some((stop) => stop.id === step.stop));
  const { data } = useQuery({
    queryKey: ["stop-records", "steps-of", order.id],
    queryFn: () =>
      call(api.GET("/api/v1/stop-records", { params: { query: { order: order.id, limit: 500 } } })),
    enabled: missing,
    staleTime: 10_000,
  });
  return useMemo(() => new Map([...(data?.items ?? []), ...own].map((stop) => [stop.id, stop])), [data, own]);
}
