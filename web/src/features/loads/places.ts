import type { Load, Vehicle } from "@/shared/api/types";
import type { LiveStation } from "@/shared/live";

/** Where a load is now; neither: not in the plant. */
export interface Place {
  vehicle?: string;
  /** Its number. */
  station?: number;
}

export const same = (a: Place, b: Place): boolean => a.vehicle === b.vehicle && a.station === b.station;

export const isNowhere = (place: Place): boolean => same(place, {});

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

/** Since when and by whom, where the server's answer is of the place that the stream has. */
export function told<T extends Place>(place: Place, answer: T): T | undefined {
  return same(place, answer) ? answer : undefined;
}

/** Where a person may say that the load is: what is free for it, and out of the plant. Where it is now is none of them. */
export function placesFor(
  { carriers }: Pick<Load, "carriers">,
  now: Place,
  vehicles: readonly Pick<Vehicle, "id" | "type" | "load">[],
  stations: readonly Pick<LiveStation, "number" | "state" | "support">[],
): { vehicles: string[]; stations: number[]; nowhere: boolean } {
  return {
    vehicles: vehicles.filter((v) => carriers.includes(v.type) && v.load === undefined).map(({ id }) => id),
    stations: stations
      .filter((s) => s.support !== undefined && s.state?.load === undefined)
      .map(({ number }) => number),
    nowhere: !isNowhere(now),
  };
}
