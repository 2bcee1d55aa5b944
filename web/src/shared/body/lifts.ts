import type { LiftCommand, Load, Reason, Vehicle } from "@/shared/api/types";
import { parseNumber } from "@/shared/words/parseNumber";

export const kAll = "all";
export type SpeedDraft = { kind: "speed"; speed_mps: number } | { kind: "full" } | { kind: "bad_speed" };
export type HeightDraft = { kind: "height"; height_m: number } | { kind: "empty" } | { kind: "bad_height" };

/** What a person typed as the height of a bracket that reaches so high, in mm. */
export function readHeight(text: string, stroke_m: number): HeightDraft {
  if (text.trim() === "") return { kind: "empty" };
  const height_mm = parseNumber(text);
  const good = height_mm !== undefined && height_mm >= 0 && height_mm <= stroke_m * 1000 + 1e-6;
  return good ? { kind: "height", height_m: Math.min(height_mm / 1000, stroke_m) } : { kind: "bad_height" };
}

/** What a person typed as the speed of brackets, in mm/s; nothing is as fast as they may. */
export function readSpeed(text: string, most_mps: number): SpeedDraft {
  if (text.trim() === "") return { kind: "full" };
  const speed_mmps = parseNumber(text);
  const good = speed_mmps !== undefined && speed_mmps >= 0.01 && speed_mmps <= most_mps * 1000 + 1e-6;
  return good ? { kind: "speed", speed_mps: Math.min(speed_mmps / 1000, most_mps) } : { kind: "bad_speed" };
}

/** The lowest and the highest bracket; undefined where the vehicle does not tell. */
export function heights(brackets: Vehicle["brackets"]): { low_m: number; high_m: number } | undefined {
  const told = brackets.flatMap((b) => (b.height_m === undefined ? [] : [b.height_m]));
  return told.length === 0 ? undefined : { low_m: Math.min(...told), high_m: Math.max(...told) };
}

/** Why brackets and feet may not be moved now, as far as the page knows; the server decides. */
export function liftBar(
  vehicle: Vehicle,
  type: LiftCommand["type"],
): "moving" | "paused" | "busy" | undefined {
  const other = vehicle.lift?.state === "under_way" && vehicle.lift.type !== type;
  if (other) return "moving";
  if (vehicle.paused || vehicle.pause_confirmed === true) return "paused";
  return vehicle.leg !== undefined ? "busy" : undefined;
}

/** Where a person may say that a load is, seen from a vehicle that stands at `station`. */
export interface SaidPlace {
  load: string;
  is: "on_vehicle" | "on_support" | "not_in_plant";
  station?: number;
}

const kUnlike = 0.05; // of its mass, where somebody has weighed it: the server bars a drive with what is further off

/** What may be so while the brackets contradict what is known. `nowhere`: loads that have no place now. */
export function placesToSay(
  vehicle: Pick<Vehicle, "load" | "lift" | "load_fault">,
  here: { number: number; support?: unknown; load: Load | undefined } | undefined,
  nowhere: readonly Load[],
): SaidPlace[] {
  const { load, load_fault } = vehicle;
  if (vehicle.lift?.state === "under_way") return [];
  if (load_fault?.code === "load_differs" && load !== undefined) {
    if (here?.support === undefined) return [{ load, is: "not_in_plant" }];
    return here.load === undefined ? [{ load, is: "on_support", station: here.number }] : [];
  }
  if (load_fault?.code !== "load_unknown") return [];
  const felt_kg = Number(load_fault.params["measured_kg"]);
  return [...(here?.load === undefined ? [] : [here.load]), ...nowhere]
    .filter(({ mass_kg }) => mass_kg === 0 || Math.abs(mass_kg - felt_kg) <= kUnlike * mass_kg)
    .map(({ id }) => ({ load: id, is: "on_vehicle" }));
}

/** A vehicle's "code: bracket front left, force_n 81234" as a reason; what does not read so is left out. */
export function reasonOf(why: string): Reason {
  const [code = "", rest = ""] = why.split(/: (.*)/s);
  const params: Reason["params"] = {};
  for (const part of rest === "" ? [] : rest.split(", ")) {
    const pair = /^([a-z_]+) (.+)$/.exec(part);
    if (pair === null) return { code, params: {} };
    const [, name = "", value = ""] = pair;
    params[name] = /^-?[\d.]+(e[+-]?\d+)?$/.test(value) ? Number(value) : value;
  }
  return { code, params };
}
