import { useInfiniteQuery, useQuery, useQueryClient } from "@tanstack/react-query";
import { useEffect, useMemo, useRef } from "react";
import { api, call } from "@/shared/api";
import type { Load, LoadState } from "@/shared/api/types";
import { useLive, usePlant, useStations, useVehicles } from "@/shared/live";
import { placeOf, placesKey, told, type Place } from "./places";

const kPage = 50;

/** A load with where it is; the rest is known once the server has told it. */
export interface LiveLoad extends Load {
  place: Place;
  told: LoadState | undefined;
}

/** Asks again for what is kept under the key when something else has come with the stream. */
function useAskedAgain(key: string, turn: string) {
  const queries = useQueryClient();
  const asked = useRef(turn);
  useEffect(() => {
    if (asked.current === turn) return;
    asked.current = turn;
    void queries.invalidateQueries({ queryKey: [key] });
  }, [queries, key, turn]);
}

/** Every load of the plant: its place comes with the stream, since when and by whom from the server. */
export function useLoads() {
  const plant = usePlant();
  const ready = useLive((s) => s.ready);
  const vehicles = useVehicles();
  const stations = useStations();
  const { data, isPending } = plant;
  const places = useMemo(
    () => (data?.loads ?? []).map(({ id }) => placeOf(id, vehicles, stations)),
    [data, vehicles, stations],
  );
  useAskedAgain("loads", placesKey(places));
  const query = useQuery({
    queryKey: ["loads"],
    queryFn: () => call(api.GET("/api/v1/loads")),
    enabled: (data?.loads ?? []).length > 0,
  });
  const items = query.data?.items;
  const loads = useMemo<LiveLoad[]>(
    () =>
      (data?.loads ?? []).map((load, index) => {
        const place = places[index] ?? {};
        return {
          ...load,
          place,
          told: told(
            place,
            items?.find(({ id }) => id === load.id),
          ),
        };
      }),
    [data, places, items],
  );
  return { loads, pending: !ready || isPending };
}

/** Where it has been, newest first, page by page. */
export function useLoadMoves({ id, place }: LiveLoad) {
  useAskedAgain("load-moves", placesKey([place]));
  const pages = useInfiniteQuery({
    queryKey: ["load-moves", id],
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
