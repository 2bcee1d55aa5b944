import { useQuery } from "@tanstack/react-query";
import { useCallback, useMemo, useSyncExternalStore } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api/client";
import type {
  Closure,
  Fleet,
  JobOrder,
  Plant,
  Station,
  StationState,
  StopRecord,
  Vehicle,
} from "@/shared/api/types";
import { closureName } from "@/shared/words/closures";
import { useNow } from "./clock";
import { inLanguage } from "./inLanguage";
import { liveStore, type LinkState, type LiveState } from "./store";

/** A part of the live state. `select` must return a value the state holds (compared by identity). */
export function useLive<T>(select: (state: LiveState) => T): T {
  return useSyncExternalStore(liveStore.subscribe, () => select(liveStore.state));
}

/** Every vehicle, by name. Never polls; changes as the server commits. */
export function useVehicles(): readonly Vehicle[] {
  const vehicles = useLive((s) => s.vehicles);
  return useMemo(
    () => [...vehicles.values()].sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true })),
    [vehicles],
  );
}

export function useVehicle(id: string | undefined): Vehicle | undefined {
  return useLive((s) => (id === undefined ? undefined : s.vehicles.get(id)));
}

/** Open orders and the newest 50 others, newest first. */
export function useJobOrders(): readonly JobOrder[] {
  const orders = useLive((s) => s.jobOrders);
  return useMemo(() => [...orders.values()].sort((a, b) => b.number - a.number), [orders]);
}

export function useJobOrder(id: string | undefined): JobOrder | undefined {
  return useLive((s) => (id === undefined ? undefined : s.jobOrders.get(id)));
}

/** The newest stop records, newest first. Older ones: GET /stop-records. */
export function useStopRecords(): readonly StopRecord[] {
  const stops = useLive((s) => s.stopRecords);
  return useMemo(() => [...stops.values()].sort((a, b) => b.at.localeCompare(a.at)), [stops]);
}

/** Goes up when a stop may have gone unmeasured. */
export function useUnmeasuredTurn(): number {
  return useLive((s) => s.unmeasuredTurn);
}

/** A station of the plant with what stands there now. */
export interface LiveStation extends Station {
  state: StationState | undefined;
}

export function useStations(): readonly LiveStation[] {
  const states = useLive((s) => s.stations);
  const plant = usePlant().data;
  return useMemo(
    () =>
      (plant?.stations ?? [])
        .map((station) => ({ ...station, state: states.get(station.id) }))
        .sort((a, b) => a.number - b.number),
    [plant, states],
  );
}

/** Floor that people have closed, oldest first. */
/** Closed floor, named in the language shown where the name is one that the page offers. */
export function useClosures(): readonly Closure[] {
  const { t } = useTranslation();
  const closures = useLive((s) => s.closures);
  return useMemo(
    () => closures.map((closure) => ({ ...closure, name: closureName(closure.name, t) })),
    [closures, t],
  );
}

export function useFleet(): Fleet | undefined {
  return useLive((s) => s.fleet);
}

/** The plant model in the language shown. Loaded again when the fleet reports another revision. */
export function usePlant() {
  const revision = useLive((s) => s.fleet?.plant_revision);
  const { language } = useTranslation().i18n;
  return useQuery<Plant>({
    queryKey: ["plant", revision],
    queryFn: () => call(api.GET("/api/v1/plant")),
    select: useCallback((plant: Plant) => inLanguage(plant, language), [language]),
    staleTime: Infinity,
    placeholderData: (previous) => previous,
  });
}

export interface LinkInfo {
  state: LinkState;
  /** Seconds since the last frame of the server; undefined before the first. */
  ageS: number | undefined;
  /** Data may be shown as live and commands may be given. */
  live: boolean;
}

/** The browser's link to the server; re-renders twice a second. */
export function useLink(): LinkInfo {
  const state = useLive((s) => s.link);
  const now = useNow(500);
  const heardAt = state.kind === "connecting" ? undefined : state.heardAt;
  const ageS = heardAt === undefined ? undefined : Math.max(0, now.monoMs - heardAt) / 1000;
  return { state, ageS, live: state.kind === "live" };
}

/** The browser's link is down: everything on the screen is old. Does not re-render with the clock. */
export function useLinkLost(): boolean {
  return useLive((s) => s.link.kind === "lost");
}

/** True while commands may be given. Does not re-render with the clock. */
export function useCommandsEnabled(): boolean {
  return useLive((s) => s.link.kind === "live" && s.ready);
}

/** Server time now, in epoch ms; re-renders every `everyMs`. Ages: `serverNow - Date.parse(x_at)`. */
export function useServerNow(everyMs = 500): number {
  const offset = useLive((s) => s.clockOffsetMs);
  return useNow(everyMs).wallMs + offset;
}
