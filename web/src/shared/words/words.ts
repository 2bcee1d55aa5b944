import type { Params } from "@/shared/api/types";
import { parameter } from "./format";

/** Names a person knows for the ids that parameters carry. */
export interface Names {
  vehicle: (id: string) => string | undefined;
  station: (id: string) => string | undefined;
  actor: (actor: string) => string;
}
export const noNames: Names = { vehicle: () => undefined, station: () => undefined, actor: (actor) => actor };

/** Raw template of a key; undefined when there is none. */
export type Template = (key: string) => string | undefined;

const vehicleParams = new Set(["vehicle", "by", "blocked_by", "nearest", "holder"]);
const stationParams = new Set(["station", "from", "to"]);
/** A vehicle or a person: "by" is said of both. */
const actorParams = new Set(["actor", "by"]);
const isId = (name: string) => vehicleParams.has(name) || stationParams.has(name) || actorParams.has(name);

/** One parameter in words. */
export function paramText(name: string, value: string | number | boolean, names: Names): string {
  if (typeof value === "boolean") return value ? "\u2713" : "\u2717";
  if (vehicleParams.has(name))
    return names.vehicle(String(value)) ?? names.station(String(value)) ?? names.actor(String(value));
  if (actorParams.has(name)) return names.actor(String(value));
  if (stationParams.has(name))
    return names.station(String(value)) ?? names.vehicle(String(value)) ?? String(value);
  return typeof value === "number" ? parameter(name, value) : value;
}

/** Ids in a reason replaced by the names people use. */
export function named(params: Params, names: Names): Params {
  const out: Params = {};
  for (const [name, value] of Object.entries(params)) {
    out[name] = typeof value === "string" && isId(name) ? paramText(name, value, names) : value;
  }
  return out;
}

const placeholder = /\{\{\s*([a-z0-9_]+)\s*\}\}/gi;

/** Fills a template when every parameter it names is there. */
export function fill(template: string, params: Params, names: Names): string | undefined {
  let complete = true;
  const text = template.replace(placeholder, (_, name: string) => {
    const value = params[name];
    if (value === undefined || value === "") {
      complete = false;
      return "";
    }
    return paramText(name, value, names);
  });
  return complete ? text : undefined;
}

/** The fullest wording whose parameters are all there: key, key_b, key_c. */
export function say(key: string, params: Params, names: Names, template: Template): string | undefined {
  for (const variant of ["", "_b", "_c"]) {
    const raw = template(key + variant);
    const text = raw === undefined ? undefined : fill(raw, params, names);
    if (text !== undefined) return text;
  }
  return undefined;
}

const unitSuffix = /_(mps|m2|m|rad|s|n|kg|c|percent|px)$/;

/** Every parameter, for a code that has no wording here. */
export function listParams(params: Params, names: Names, join: string): string {
  return Object.entries(params)
    .map(
      ([name, value]) =>
        `${name.replace(unitSuffix, "").replaceAll("_", " ")} ${paramText(name, value, names)}`,
    )
    .join(join);
}
