import type { Vehicle } from "@/shared/api/types";
import { fixed, length } from "./format";

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
    case "receivers":
      return { key: "receivers", values: { time: at }, since };
    case "reflectors":
      return { key: "reflectors", values: { time: at }, since };
    case "statement":
      return { key: "statement", values: { by: who(basis.by ?? ""), time: at }, since };
    case "vehicle":
      return { key: "vehicle", values: { time: at }, since };
  }
}

export interface LightWords {
  /** How much it sees: of iGPS all receivers know their place, enough of them, or too few. */
  key: "all" | "some" | "none";
  values: Record<string, string>;
}

/** Two receivers tell a direction. */
const kReceivers = 2;

/** What the receivers of iGPS see; undefined: the vehicle has none. */
export function lightWords(v: Vehicle): LightWords | undefined {
  const receivers = v.receivers ?? [];
  if (receivers.length === 0) return undefined;
  const lit = receivers.filter((one) => one.found);
  const names = new Set(receivers.flatMap((one) => one.transmitters));
  const sigmas = lit.map((one) => one.sigma_m ?? 0);
  const values = {
    lit: String(lit.length),
    all: String(receivers.length),
    transmitters: String(names.size),
    sigma: fixed(1000 * Math.max(0, ...sigmas), 2),
  };
  if (lit.length < kReceivers) return { key: "none", values };
  return { key: lit.length === receivers.length ? "all" : "some", values };
}

/** Three fit one pose only; with two it goes on from where it is. */
const kReflectors = 3;

/** What the navigation scanner sees of the reflectors around; undefined: the vehicle has none. */
export function reflectorWords(v: Vehicle): LightWords | undefined {
  const seen = v.reflectors_in_view;
  if (seen === undefined) return undefined;
  return { key: seen >= kReflectors ? "all" : seen > 0 ? "some" : "none", values: { seen: String(seen) } };
}

export interface NavigationWords {
  key: NonNullable<Vehicle["navigation"]>["by"];
  /** Driven since then by its wheels; undefined: not at all. */
  since: string | undefined;
  /** Of what its scanners meet, percent that its map has; undefined: no map. */
  explained: string | undefined;
  /** Reason code: its scanners do not fit the map. */
  whyNot: string | undefined;
}

/** What the vehicle itself steers by; undefined: it does not say. */
export function navigationWords(v: Vehicle): NavigationWords | undefined {
  const said = v.navigation;
  if (said === undefined) return undefined;
  return {
    key: said.by,
    since: said.driven_m >= kMoved_m ? length(said.driven_m) : undefined,
    explained: said.explained === undefined ? undefined : fixed(100 * said.explained, 0),
    whyNot: said.why_not,
  };
}
