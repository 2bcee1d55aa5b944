import type { Load, LoadState, Vehicle, VehicleType } from "@/shared/api/types";
import type { LiveStation } from "@/shared/live";

/** Where a load is now; neither: not in the plant. */
export interface Place {
  vehicle?: string;
  /** Its number. */
  station?: number;
}

export const same = (a: Place, b: Place): boolean => a.vehicle === b.vehicle && a.station === b.station;

/** As the stream has it. */
export function placeOf(
  load: string,
  vehicles: readonly Pick<Vehicle, "id" | "load">[],
  stations: readonly Pick<LiveStation, "number" | "state">[],
): Place {
  const on = vehicles.find((one) => one.load === load);
  if (on) return { vehicle: on.id };
  const at = stations.find((one) => one.state?.load === load);
  return at ? { station: at.number } : {};
}

/** What changes when any load gets elsewhere: since when and by whom is then asked again. */
export function placesKey(places: readonly Place[]): string {
  return places.map(({ vehicle, station }) => vehicle ?? station ?? "-").join(" ");
}

/** Since when and by whom, where the server's answer is of the place that the stream has. */
export function told(place: Place, state: LoadState | undefined): LoadState | undefined {
  return state !== undefined && same(place, state) ? state : undefined;
}

/** Types that may carry it, as the server decides it by name and mass. */
export function carriers(load: Load, types: readonly VehicleType[]): VehicleType[] {
  const named = load.vehicle_types ?? [];
  return types.filter(
    ({ id, brackets, max_load_kg }) =>
      (named.length === 0 ? brackets.length > 0 : named.includes(id)) && load.mass_kg <= max_load_kg,
  );
}

/** Where a person may say that the load is: what is free for it, and out of the plant. Where it is now is none of them. */
export function placesFor(
  load: Load,
  now: Place,
  types: readonly VehicleType[],
  vehicles: readonly Pick<Vehicle, "id" | "type" | "load">[],
  stations: readonly Pick<LiveStation, "number" | "state" | "support">[],
): { vehicles: string[]; stations: number[]; nowhere: boolean } {
  const may = new Set(carriers(load, types).map(({ id }) => id));
  return {
    vehicles: vehicles.filter((v) => may.has(v.type) && v.load === undefined).map(({ id }) => id),
    stations: stations
      .filter((s) => s.support !== undefined && s.state?.load === undefined)
      .map(({ number }) => number),
    nowhere: !same(now, {}),
  };
}
