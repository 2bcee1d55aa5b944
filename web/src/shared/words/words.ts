import * as format from "./format";

export type ParamValue = string | number | boolean;
export type Params = Record<string, ParamValue>;
export interface Reason {
  code: string;
  params: Params;
}

/** Names a person knows for the ids that parameters carry. */
export interface Names {
  vehicle: (id: string) => string | undefined;
  station: (id: string) => string | undefined;
}
export const noNames: Names = { vehicle: () => undefined, station: () => undefined };

/** Raw template of a key in the `words` namespace or the given one; undefined when there is none. */
export type Template = (key: string) => string | undefined;

const vehicleParams = new Set(["vehicle", "by", "blocked_by", "nearest", "holder", "blocker", "other"]);
const stationParams = new Set(["station", "from", "to", "at_station", "target"]);

/** One parameter in words; the unit is read from its name. */
export function paramText(name: string, value: ParamValue, names: Names): string {
  if (typeof value === "number") {
    if (name.endsWith("_mps")) return `${format.number(value, { decimals: 2 })}\u00a0m/s`;
    if (name.endsWith("_m2")) return `${format.number(value)}\u00a0m²`;
    if (name.endsWith("_m")) return format.length(value);
    if (name.endsWith("_rad")) return `${format.degrees(value, { decimals: 2 })}°`;
    if (name.endsWith("_s")) return value < 60 ? format.age(value) : format.duration(value);
    if (name.endsWith("_n")) return `${format.kilonewtons(value)}\u00a0kN`;
    if (name.endsWith("_kg")) return format.tonnes(value);
    if (name.endsWith("_c")) return `${format.number(value)}\u00a0°C`;
    if (name.endsWith("_percent")) return `${format.number(value)}\u00a0%`;
    if (name.endsWith("_px")) return `${format.number(value, { decimals: 2 })}\u00a0px`;
    if (stationParams.has(name)) return names.station(String(value)) ?? String(value);
    return format.number(value, { decimals: Number.isInteger(value) ? 0 : 2 });
  }
  if (typeof value === "boolean") return value ? "\u2713" : "\u2717";
  if (vehicleParams.has(name)) return names.vehicle(value) ?? names.station(value) ?? value;
  if (stationParams.has(name)) return names.station(value) ?? names.vehicle(value) ?? value;
  return value;
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

/** The fullest wording whose parameters are all there: key, key_b, key_c, ... */
export function say(key: string, params: Params, names: Names, template: Template): string | undefined {
  for (const variant of ["", "_b", "_c", "_d"]) {
    const raw = template(key + variant);
    if (raw === undefined) {
      if (variant === "") return undefined;
      continue;
    }
    const text = fill(raw, params, names);
    if (text !== undefined) return text;
  }
  return undefined;
}

/** A reason in words. A code that this screen does not know is shown with all it carries. */
export function reasonText(reason: Reason, names: Names, template: Template): string {
  const known = say(`reason.${reason.code}`, reason.params, names, template);
  if (known !== undefined) return known;
  const name = fill(template("reason.unnamed") ?? "{{code}}", { code: reason.code.replaceAll("_", " ") }, noNames);
  const list = listParams(reason.params, names, template);
  return list === "" ? (name ?? reason.code) : `${name ?? reason.code} (${list})`;
}

export function listParams(params: Params, names: Names, template: Template): string {
  return Object.entries(params)
    .map(([name, value]) => `${plainName(name)} ${paramText(name, value, names)}`)
    .join(template("join") ?? ", ");
}

const unitSuffix = /_(mps|m2|m|rad|s|n|kg|c|percent|px)$/;

function plainName(name: string): string {
  return name.replace(unitSuffix, "").replaceAll("_", " ");
}
