import { useQuery, type QueryClient } from "@tanstack/react-query";
import { useCallback } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api/client";
import type { Load } from "@/shared/api/types";
import { useLive } from "./hooks";
import { namedIn } from "./inLanguage";
import type { LiveStore } from "./store";

/** Under it lies whatever was asked about loads, the list itself at the top. */
export const kLoads = ["loads"] as const;

/** What is known of every load, in the language shown. Where each is now comes with the stream. */
export function useLoads() {
  const ready = useLive((s) => s.ready);
  const { language } = useTranslation().i18n;
  return useQuery({
    queryKey: kLoads,
    queryFn: async () => (await call(api.GET("/api/v1/loads"))).items,
    select: useCallback((loads: Load[]) => loads.map((load) => namedIn(load, language)), [language]),
    enabled: ready,
    staleTime: Infinity, // watchLoads says when it is old
  });
}

/** Calls `again` when a snapshot or an event says that something about loads may have changed. Gives its end. */
export function watchLoads(store: LiveStore, again: () => void): () => void {
  let known = store.state.loadsTurn;
  return store.subscribe(() => {
    const turn = store.state.loadsTurn;
    if (turn === known) return;
    known = turn;
    if (turn !== 0) again();
  });
}

/** What the server has answered to a change is shown at once, and not what it was asked before that. */
export async function takeChange(queries: QueryClient, change: (known: Load[]) => Load[]): Promise<void> {
  await queries.cancelQueries({ queryKey: kLoads, exact: true });
  queries.setQueryData<Load[]>(kLoads, (known) => known && change(known));
  void queries.invalidateQueries({ queryKey: kLoads });
}
