import type { Vehicle, VehicleType } from "@/shared/api/types";
import { bracketFault } from "@/shared/live/brackets";

export type BracketReading = Vehicle["brackets"][number];

/** Half-width of the band around a pin's bar, as a share of the mean of its end. */
export const kBandShare = 0.1;

export interface LoadSummary {
  total_n: number;
  mean_n: number;
  brackets: { name: string; sum_n: number; a: SensorShare; b: SensorShare }[];
  worst: number; // largest departure of a bracket from the mean of its end, as a share
  balanced: boolean;
}
export interface SensorShare {
  force_n: number;
  share: number; // (force - reference) / reference
}

/** The forces beside the mean of their end; whether they are balanced is the server's word, which bars the drive by it. */
export function summarise(
  vehicle: Pick<Vehicle, "brackets" | "worst_bracket">,
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
  const fault = bracketFault(vehicle);
  const reference = (name: string) => {
    const ofEnd = brackets.filter((b) => endOf(b.name) === endOf(name));
    // A bracket that is far off would make its sound neighbour look wrong.
    const sound = ofEnd.filter((b) => b.name !== fault?.bracket);
    const same = sound.length > 0 ? sound : ofEnd;
    return same.reduce((s, b) => s + b.force_a_n + b.force_b_n, 0) / (2 * same.length);
  };
  const rows = brackets.map((b) => {
    const ref = reference(b.name);
    const share = (f: number): SensorShare => ({ force_n: f, share: ref > 0 ? (f - ref) / ref : 0 });
    return { name: b.name, sum_n: b.force_a_n + b.force_b_n, a: share(b.force_a_n), b: share(b.force_b_n) };
  });
  return {
    total_n: total,
    mean_n: total / (2 * brackets.length),
    brackets: rows,
    worst: Math.abs(vehicle.worst_bracket?.share ?? 0),
    balanced: fault === undefined,
  };
}

/** Half the distance between a bracket's two pins, along the body: ours, Tang 2020 does not give it. */
export const kPinOffset_m = 0.25;

/** Where the load's weight acts in the body frame; nothing without load or without known brackets. */
export function centreOfLoad(
  brackets: readonly BracketReading[],
  type: VehicleType | undefined,
): { x_m: number; y_m: number } | undefined {
  let total = 0;
  let mx = 0;
  let my = 0;
  for (const b of brackets) {
    const at = type?.brackets.find((t) => t.name === b.name)?.position;
    if (!at) return undefined;
    const sum = b.force_a_n + b.force_b_n;
    total += sum;
    mx += b.force_a_n * (at.x_m + kPinOffset_m) + b.force_b_n * (at.x_m - kPinOffset_m);
    my += sum * at.y_m;
  }
  if (total <= 100) return undefined; // under 10 kg it is noise
  return { x_m: mx / total, y_m: my / total };
}

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
