import type { Vehicle, VehicleType } from "@/shared/api/types";

export type BracketReading = Vehicle["brackets"][number];

/** How far a bracket may differ from the mean of its end; beyond it the server lets nobody drive (core/fleet/interlocks.hpp). */
export const kBalanceShare = 0.1;

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

/** Each bracket is compared with the mean of its end (front or back): a load aft of the middle is normal, one that leans is not. */
export function summarise(
  brackets: readonly BracketReading[],
  type: VehicleType | undefined,
): LoadSummary | undefined {
  if (brackets.length === 0) return undefined;
  const total = brackets.reduce((s, b) => s + b.force_a_n + b.force_b_n, 0);
  const places = type?.brackets ?? [];
  const middle = places.reduce((sum, b) => sum + b.position.x_m / places.length, 0);
  const endOf = (name: string) => {
    const x = places.find((b) => b.name === name)?.position.x_m;
    return x === undefined ? 0 : Math.sign(x - middle);
  };
  const reference = (name: string) => {
    const same = brackets.filter((b) => endOf(b.name) === endOf(name));
    return same.reduce((s, b) => s + b.force_a_n + b.force_b_n, 0) / (2 * same.length);
  };
  const rows = brackets.map((b) => {
    const ref = reference(b.name);
    const share = (f: number): SensorShare => ({ force_n: f, share: ref > 0 ? (f - ref) / ref : 0 });
    return { name: b.name, sum_n: b.force_a_n + b.force_b_n, a: share(b.force_a_n), b: share(b.force_b_n) };
  });
  // Two sensors a bracket: the mean of its shares is the bracket's own.
  const worst = Math.max(...rows.map((r) => Math.abs(r.a.share + r.b.share) / 2));
  return {
    total_n: total,
    mean_n: total / (2 * brackets.length),
    brackets: rows,
    worst,
    balanced: worst <= kBalanceShare,
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
