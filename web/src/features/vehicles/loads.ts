import type { Vehicle, VehicleType } from "@/shared/api/types";
import { bracketFault } from "@/shared/live/brackets";

export type BracketReading = Vehicle["brackets"][number];

/** Half-width of the band around the mean in which eight sensors count as balanced. */
export const kBalanceShare = 0.05;

export interface LoadSummary {
  total_n: number;
  mean_n: number;
  brackets: { name: string; sum_n: number; a: SensorShare; b: SensorShare }[];
  worst: number; // largest departure of one sensor from its bracket group's mean, as a share
  balanced: boolean;
}
export interface SensorShare {
  force_n: number;
  share: number; // (force - reference) / reference
}

/**
 * Each sensor is compared with the mean of its end (front or back): a load aft of the middle is
 * normal, a pin that carries more than its neighbours at the same end is not.
 */
export function summarise(
  brackets: readonly BracketReading[],
  type: VehicleType | undefined,
): LoadSummary | undefined {
  if (brackets.length === 0) return undefined;
  const total = brackets.reduce((s, b) => s + b.force_a_n + b.force_b_n, 0);
  const endOf = (name: string) => {
    const x = type?.brackets.find((b) => b.name === name)?.position.x_m;
    return x === undefined ? 0 : Math.sign(x);
  };
  const worst = bracketFault(brackets)?.bracket;
  const reference = (name: string) => {
    const ofEnd = brackets.filter((b) => endOf(b.name) === endOf(name));
    // A bracket that is far off would make its sound neighbour look wrong.
    const sound = ofEnd.filter((b) => b.name !== worst);
    const same = sound.length > 0 ? sound : ofEnd;
    return same.reduce((s, b) => s + b.force_a_n + b.force_b_n, 0) / (2 * same.length);
  };
  const rows = brackets.map((b) => {
    const ref = reference(b.name);
    const share = (f: number): SensorShare => ({ force_n: f, share: ref > 0 ? (f - ref) / ref : 0 });
    return { name: b.name, sum_n: b.force_a_n + b.force_b_n, a: share(b.force_a_n), b: share(b.force_b_n) };
  });
  const largest = Math.max(...rows.flatMap((r) => [Math.abs(r.a.share), Math.abs(r.b.share)]));
  return {
    total_n: total,
    mean_n: total / (2 * brackets.length),
    brackets: rows,
    worst: largest,
    balanced: largest <= kBalanceShare,
  };
}

/** Distance of a sensor's two pins from the bracket's middle, along the body (Tang 2020, Fig. 5). */
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
