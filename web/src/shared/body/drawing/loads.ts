import type { Reason, Vehicle, VehicleType } from "@/shared/api/types";
import { bracketFault } from "@/shared/live/brackets";

export interface LoadSummary {
  total_n: number;
  mean_n: number;
  brackets: { name: string; height_m?: number | undefined; sum_n: number; a: SensorShare; b: SensorShare }[];
  worst: number; // largest departure of a bracket from the mean of its end, as a share
  limit: number; // of it, by the rules of the vehicle's type
  fault: Reason | undefined; // the rule that the load breaks: the server's word, which bars the drive by it
}
export interface SensorShare {
  force_n: number;
  share: number; // (force - reference) / reference
}

/** The forces beside the mean of their end. */
export function summarise(
  vehicle: Pick<Vehicle, "brackets" | "worst_bracket" | "load_fault">,
  type: VehicleType | undefined,
): LoadSummary | undefined {
  const { brackets } = vehicle;
  if (brackets.length === 0) return undefined;
  const total = brackets.reduce((s, b) => s + b.force_a_n + b.force_b_n, 0);
  const places = type?.brackets ?? [];
  const middle = places.reduce((sum, b) => sum + b.position.x_m / places.length, 0);
  const endOf = (name: string) => {
    const x = places.find((b) => b.name === name)?.position.x_m;
    return x === undefined ? 0 : Math.sign(x - middle);
  };
  const off = bracketFault(vehicle)?.bracket;
  const reference = (name: string) => {
    const ofEnd = brackets.filter((b) => endOf(b.name) === endOf(name));
    // A bracket that is far off would make its sound neighbour look wrong.
    const sound = ofEnd.filter((b) => b.name !== off);
    const same = sound.length > 0 ? sound : ofEnd;
    return same.reduce((s, b) => s + b.force_a_n + b.force_b_n, 0) / (2 * same.length);
  };
  const rows = brackets.map((b) => {
    const ref = reference(b.name);
    const share = (f: number): SensorShare => ({ force_n: f, share: ref > 0 ? (f - ref) / ref : 0 });
    const sum_n = b.force_a_n + b.force_b_n;
    return { name: b.name, height_m: b.height_m, sum_n, a: share(b.force_a_n), b: share(b.force_b_n) };
  });
  return {
    total_n: total,
    mean_n: total / (2 * brackets.length),
    brackets: rows,
    worst: Math.abs(vehicle.worst_bracket?.share ?? 0),
    limit: type?.load_rules?.most_unbalance ?? vehicle.worst_bracket?.limit ?? 0,
    fault: vehicle.load_fault,
  };
}

/** Half the distance between a bracket's two pins, along the body: ours, Tang 2020 does not give it. */
export const kPinOffset_m = 0.25;

/** The words over the drawing name only what this vehicle has. */
export function titleOf(
  vehicle: Pick<Vehicle, "brackets" | "parking_feet">,
  type: Pick<VehicleType, "brackets"> | undefined,
): "loads.title" | "loads.title_load" | "loads.title_feet" | "loads.title_wheels" {
  const load = vehicle.brackets.length > 0 || (type?.brackets.length ?? 0) > 0;
  const feet = vehicle.parking_feet.length > 0;
  if (load) return feet ? "loads.title" : "loads.title_load";
  return feet ? "loads.title_feet" : "loads.title_wheels";
}
