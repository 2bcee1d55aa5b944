import type { Fleet, Vehicle } from "@/shared/api/types";
import { silent } from "./attention";

/** What has become of the pause of a vehicle, by its own reports only. */
export type Halt = "none" | "stopping" | "stands" | "unheard";

export function haltOf(v: Vehicle): Halt {
  if (!v.paused) return "none";
  if (v.pause?.stands) return "stands";
  return silent(v) || v.link === "never" ? "unheard" : "stopping";
}

/** Vehicles that can move in the hall: those that never came, or were taken out of it, stop nobody's count. */
export const takesPart = (v: Vehicle) =>
  v.link !== "never" && v.integration !== "ignore" && v.integration !== "notice";

export interface FleetHalt {
  by: string | undefined;
  at: string | undefined;
  /** Of those that take part. */
  total: number;
  held: number;
  moving: number;
  unheard: number;
  /** Nobody has been let go since. */
  all: boolean;
}

/** The pause of the whole fleet; undefined when no vehicle is paused by one. */
export function fleetHalt(fleet: Fleet | undefined, vehicles: readonly Vehicle[]): FleetHalt | undefined {
  if (fleet === undefined || (fleet.pause === undefined && !fleet.paused)) return undefined;
  const part = vehicles.filter(takesPart);
  const count = (halt: Halt) => part.filter((v) => haltOf(v) === halt).length;
  return {
    by: fleet.pause?.by,
    at: fleet.pause?.at,
    total: part.length,
    held: part.length - count("none"),
    moving: count("stopping"),
    unheard: count("unheard"),
    all: fleet.paused,
  };
}

/** Vehicles that a person paused one by one. */
export const pausedSingly = (vehicles: readonly Vehicle[]) =>
  vehicles.filter((v) => v.paused && v.pause?.with_fleet !== true);
