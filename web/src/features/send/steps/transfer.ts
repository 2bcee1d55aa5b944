import type { Load, Station, StationState, Vehicle } from "@/shared/api/types";
import type { StepAction } from "@/shared/words/actions";

/** What can be done with a load at the station: taken over from its support, or set down on it. */
export interface Transfer {
  type: "pick" | "drop";
  load: string; // its id
  /** As a person has chosen it: the same at another station, or of another load, is another choice. */
  key: string;
}

export function transferAt(
  station: Station | undefined,
  states: readonly StationState[],
  vehicle: Pick<Vehicle, "id" | "type" | "load" | "brackets"> | undefined,
  loads: readonly Load[],
): Transfer | undefined {
  if (!station?.support || !vehicle || vehicle.brackets.length === 0) return undefined;
  const there = states.find((s) => s.station === station.id)?.load;
  const key = (type: string, load: string) => [type, load, vehicle.id, station.id].join(" ");
  if (vehicle.load === undefined && there !== undefined) {
    const known = loads.find((load) => load.id === there);
    if (known && !known.carriers.includes(vehicle.type)) return undefined;
    return { type: "pick", load: there, key: key("pick", there) };
  }
  if (vehicle.load !== undefined && there === undefined)
    return { type: "drop", load: vehicle.load, key: key("drop", vehicle.load) };
  return undefined;
}

export function transferAction({ type, load }: Transfer): StepAction {
  return type === "pick" ? { type, parameters: { load } } : { type };
}
