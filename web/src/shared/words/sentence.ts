import type { Params } from "@/shared/api/types";
import { faultText } from "./faults";
import { parameter } from "./format";

/** The part of i18next's `t` that is used here; a table in the tests. */
export type Translate = (key: string, values?: Record<string, unknown>) => string;

/** Names a person knows for the ids that parameters carry. */
export type Names = Readonly<
  Record<"vehicle" | "station" | "actor" | "wheel" | "closure" | "load", (id: string) => string | undefined>
>;
const none = () => undefined;
export const noNames: Names = {
  vehicle: none,
  station: none,
  actor: none,
  wheel: none,
  closure: none,
  load: none,
};

/** Of what a parameter is the id, the likeliest first: "by" is said of vehicles and of people. */
const kIds: Readonly<Record<string, readonly (keyof Names)[]>> = {
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
  load: ["load"],
};

/** Parameters that are codes themselves, and where their words are. */
const kCodes: Readonly<Record<string, string>> = {
  cause: "reasons:",
  mode: "words:mode.",
  motion_mode: "words:mode.",
  state: "words:job.",
  level: "words:integration.",
  action: "words:action.",
};
const kFaults = ["type", "fault"];

const kMissing = "\u0000";

/** The wording of a key as the catalogue has it, its holes open; undefined when there is none. */
function template(key: string, t: Translate): string | undefined {
  const text = t(key, { defaultValue: kMissing, skipInterpolation: true });
  return text === kMissing || text === "" ? undefined : text;
}

const kVariants = ["", "_b", "_c", "_d"];

/** The words of a code, where it has some that need no parameters. */
function codeText(key: string, t: Translate): string | undefined {
  const texts = kVariants.map((variant) => template(key + variant, t));
  return texts.find((text) => text !== undefined && !text.includes("{{"));
}

/** A vehicle's "code: prose in its own language": the code has words here, or it is left out. */
function whyText(value: string, t: Translate): string | undefined {
  const code = /^([a-z][a-z0-9_]*)(: |$)/.exec(value);
  if (code === null) return value;
  return codeText(`reasons:${code[1]}`, t) ?? (code[2] === "" ? value.replaceAll("_", " ") : undefined);
}

function worded(name: string, value: string, names: Names, t: Translate): string | undefined {
  if (name === "why") return whyText(value, t);
  if (name === "state" && value === "Aborted") return t("words:job.given_up"); // a refusal does not tell which of the two it was
  if (kFaults.includes(name)) return faultText(value, t);
  if (name === "bracket")
    return t(`alarms:bracket_name.${value.toLowerCase().replaceAll(" ", "_")}`, { defaultValue: value });
  const code = Object.hasOwn(kCodes, name) ? codeText(`${kCodes[name]}${value}`, t) : undefined;
  const kinds = Object.hasOwn(kIds, name) ? (kIds[name] ?? []) : [];
  return code ?? kinds.map((kind) => names[kind](value)).find((text) => text !== undefined) ?? value;
}

/** Every parameter in words: ids by their names, codes by theirs, numbers with their units. What says nothing is left out. */
function inWords(params: Params, names: Names, t: Translate): Map<string, string> {
  const words = new Map<string, string>();
  for (const [name, value] of Object.entries(params)) {
    if (value === "") continue;
    const text =
      typeof value === "string"
        ? worded(name, value, names, t)
        : typeof value === "number"
          ? parameter(name, value)
          : value
            ? "\u2713"
            : "\u2717";
    if (text !== undefined) words.set(name, text);
  }
  return words;
}

const kHole = /\{\{\s*([a-z0-9_]+)\s*\}\}/gi;

/**
 * The fullest wording of a key whose parameters are all there: key, key_b, key_c, key_d. A value is put in as it is, never read as
 * a wording.
 */
export function sentence(key: string, params: Params, names: Names, t: Translate): string | undefined {
  const words = inWords(params, names, t);
  for (const variant of kVariants) {
    const text = template(key + variant, t);
    if (text === undefined) continue;
    if ([...text.matchAll(kHole)].every(([, name]) => words.has(name ?? "")))
      return text.replace(kHole, (_, name: string) => words.get(name) ?? "");
  }
  return undefined;
}

const kUnit = /_(mps|m2|m|rad|s|n|kg|c|percent|px)$/;

/** Every parameter by its name, for a code that has no wording here. */
export function listed(params: Params, names: Names, t: Translate): string {
  return [...inWords(params, names, t)]
    .map(([name, text]) => `${name.replace(kUnit, "").replaceAll("_", " ")} ${text}`)
    .join(t("words:join"));
}
