import type { Vehicle } from "@/shared/api/types";
import { length } from "./format";

/** Driven less than this it still stands where it was measured. */
const kMoved_m = 0.05;

export interface PoseWords {
  /** Key of the sentence, with its values: what the pose rests on. */
  key: string;
  values: Record<string, string>;
  /** How far the vehicle has driven by its own reckoning since then; undefined: not at all. */
  since: string | undefined;
}

/** What a pose rests on, from what the server has seen; never "confirmed" and no more. */
export function poseWords(
  v: Vehicle,
  number: (station: string) => string,
  time: (at: string) => string,
  who: (actor: string) => string,
): PoseWords {
  const basis = v.pose_basis;
  if (!v.pose_known) return { key: "unknown", values: {}, since: undefined };
  if (basis === undefined) return { key: "vehicle_plain", values: {}, since: undefined };
  const since = basis.driven_m >= kMoved_m ? length(basis.driven_m) : undefined;
  const at = time(basis.at);
  switch (basis.kind) {
    case "stop":
      return { key: "stop", values: { number: number(basis.station ?? ""), time: at }, since };
    case "codes":
      return { key: "codes", values: { time: at }, since };
    case "statement":
      return { key: "statement", values: { by: who(basis.by ?? ""), time: at }, since };
    case "vehicle":
      return { key: "vehicle", values: { time: at }, since };
  }
}
