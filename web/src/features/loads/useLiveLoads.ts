import { useInfiniteQuery } from "@tanstack/react-query";
import { useMemo } from "react";
import { api, call } from "@/shared/api";
import type { Load } from "@/shared/api/types";
import { kLoads, useLoads, usePlant, useStations, useVehicles } from "@/shared/live";
import { placeOf, told, type Place } from "./places";

const kPage = 50;

/** A load with where it is; since when and by whom once the server has told it of that place. */
export interface LiveLoad extends Load {
  place: Place;
  told: Pick<Load, "since" | "by"> | undefined;
}

/** Every load: its place comes with the stream, the rest from the server. */
export function useLiveLoads() {
  const plant = usePlant();
  const query = useLoads();
  const vehicles = useVehicles();
  const stations = useStations();
  const known = query.data;
  const loads = useMemo<LiveLoad[]>(
    () =>
      (known ?? []).map((load) => {
        const place = placeOf(load.id, vehicles, stations);
        return { ...load, place, told: told(place, load) };
      }),
    [known, vehicles, stations],
  );
  return {
    loads,
    // Before the plant has come no station is known, and what hangs at one would be said to be nowhere.
    pending: plant.isPending || query.isPending,
    failed: known === undefined && query.isError ? query.error : undefined,
    again: () => void query.refetch(),
  };
}

/** Where it has been, newest first, page by page. */
export function useLoadMoves(id: string) {
  const pages = useInfiniteQuery({
    queryKey: [...kLoads, id, "moves"],
    initialPageParam: "",
    queryFn: ({ pageParam }) =>
      call(
        api.GET("/api/v1/loads/{id}/moves", {
          params: {
            path: { id },
            query: { limit: kPage, ...(pageParam !== "" && { cursor: pageParam }) },
          },
        }),
      ),
    getNextPageParam: (last) => last.next_cursor || undefined,
  });
  const moves = useMemo(() => pages.data?.pages.flatMap((p) => p.items) ?? [], [pages.data]);
  return { moves, pages };
}
