import type { Params } from "@/shared/api/types";
import { parameter } from "./format";

/** Names a person knows for the ids and codes that parameters carry. */
export type Names = Readonly<
  Record<"vehicle" | "station" | "actor" | "wheel" | "closure" | "fault", (id: string) => string | undefined>
>;
const none = () => undefined;
export const noNames: Names = {
  vehicle: none,
  station: none,
  actor: none,
  wheel: none,
  closure: none,
  fault: none,
};

/** Raw template of a key; undefined when there is none. */
export type Template = (key: string) => string | undefined;

/** Of what a parameter is the id, the likeliest first: "by" is said of vehicles and of people. */
const kNamed: Readonly<Record<string, readonly (keyof Names)[]>> = {
  vehicle: ["vehicle", "station"],
  by: ["vehicle", "station", "actor"],
  blocked_by: ["vehicle", "station"],
  nearest: ["vehicle", "station"],
  holder: ["vehicle", "station"],
  station: ["station", "vehicle"],
  from: ["station", "vehicle"],
  to: ["station", "vehicle"],
  actor: ["actor"],
  wheel: ["wheel"],
  closure: ["closure"],
  fault: ["fault"],
};

/** One parameter in words. */
export function paramText(name: string, value: string | number | boolean, names: Names): string {
  if (typeof value === "boolean") return value ? "\u2713" : "\u2717";
  const kinds = Object.hasOwn(kNamed, name) ? (kNamed[name] ?? []) : [];
  for (const kind of kinds) {
    const text = names[kind](String(value));
    if (text !== undefined) return text;
  }
  if (kinds.length > 0) return String(value);
  return typeof value === "number" ? parameter(name, value) : value;
}

/** Ids in a reason replaced by the names people use; its faults are put into words with it. */
export function named(params: Params, names: Names): Params {
  const out: Params = {};
  for (const [name, value] of Object.entries(params)) {
    const isId = typeof value === "string" && Object.hasOwn(kNamed, name) && name !== "fault";
    out[name] = isId ? paramText(name, value, names) : value;
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
