import type { Vehicle } from "@/shared/api/types";

/** Parameters of a reason that name who is in the way; obstacles and walls are named there, too. */
const kWho = ["by", "blocked_by", "holder", "vehicle"] as const;

/** The vehicle that this one says it waits for. */
export function blockerOf(v: Vehicle, vehicles: ReadonlyMap<string, Vehicle>): string | undefined {
  if (v.activity !== "waiting" || v.reason === undefined) return undefined;
  const { params } = v.reason;
  const named = kWho.map((name) => params[name]);
  return named.find((id): id is string => typeof id === "string" && id !== v.id && vehicles.has(id));
}

export interface WaitChain {
  /** Whom it waits for, whom that one waits for, and so on. */
  ids: readonly string[];
  /** The last of them waits for one that is before it in the chain. */
  loop: boolean;
}

/** Who waits for whom, from a vehicle on. Each vehicle tells its own; nothing here is guessed. */
export function waitChain(v: Vehicle, vehicles: ReadonlyMap<string, Vehicle>): WaitChain {
  const ids: string[] = [];
  let at: Vehicle | undefined = v;
  while (at !== undefined) {
    const next = blockerOf(at, vehicles);
    if (next === undefined) return { ids, loop: false };
    if (next === v.id || ids.includes(next)) return { ids, loop: true };
    ids.push(next);
    at = vehicles.get(next);
  }
  return { ids, loop: false };
}

/** The other one of two that wait for each other: a list says so once and does not send people to and fro. */
export function eachOther(v: Vehicle, vehicles: ReadonlyMap<string, Vehicle>): string | undefined {
  const id = blockerOf(v, vehicles);
  const other = id === undefined ? undefined : vehicles.get(id);
  return other !== undefined && blockerOf(other, vehicles) === v.id ? id : undefined;
}
