import type { Plant, Station, StationState, Vehicle } from "@/shared/api/types";

/** What the number pad shows of the typed number, before anything is asked of the server. */
export type StationEntry =
  | { kind: "empty" }
  | { kind: "unknown"; digits: string }
  | { kind: "wrong_type"; station: Station }
  | { kind: "here"; station: Station }
  | { kind: "occupied"; station: Station; by: string }
  | { kind: "reserved"; station: Station; by: string }
  | { kind: "free"; station: Station };

export function lookUpStation(
  digits: string,
  plant: Plant | undefined,
  states: readonly StationState[],
  vehicle: Vehicle | undefined,
): StationEntry {
  if (digits === "") return { kind: "empty" };
  const number = Number(digits);
  const station = plant?.stations.find((s) => s.number === number);
  if (!station) return { kind: "unknown", digits };
  if (vehicle && station.vehicle_types.length > 0 && !station.vehicle_types.includes(vehicle.type))
    return { kind: "wrong_type", station };
  const state = states.find((s) => s.station === station.id);
  if (vehicle && (vehicle.at_station === station.id || state?.occupied_by === vehicle.id))
    return { kind: "here", station };
  if (state?.occupied_by) return { kind: "occupied", station, by: state.occupied_by };
  if (state?.reserved_by && state.reserved_by !== vehicle?.id)
    return { kind: "reserved", station, by: state.reserved_by };
  return { kind: "free", station };
}

export function stationOf(entry: StationEntry): Station | undefined {
  return "station" in entry ? entry.station : undefined;
}
