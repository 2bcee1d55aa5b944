import type { Params, Reason } from "@/shared/api/types";
import { faultText } from "@/shared/words/faults";
import { length } from "@/shared/words/format";
import { age, deg, fixed, kThin, mass } from "./format";

/** The part of i18next's `t` that is used here; a table in the tests. */
export type Translate = (key: string, values?: Record<string, unknown>) => string;

const kMissing = "\u0000";

function words(t: Translate, key: string, values: Record<string, unknown>): string | undefined {
  const text = t(key, { ...values, defaultValue: kMissing });
  return text === kMissing || text === "" ? undefined : text;
}

/** The fullest wording whose parameters are all there: code, code_b, code_c, code_d. */
function sentence(t: Translate, code: string, values: Record<string, string>): string | undefined {
  for (const variant of ["", "_b", "_c", "_d"]) {
    const text = words(t, `reasons:${code}${variant}`, values);
    if (text !== undefined && !text.includes("{{")) return text;
  }
  return undefined;
}

/** One parameter as a person reads it: the unit is in its name. */
export function paramText(name: string, value: string | number | boolean): string {
  if (typeof value !== "number") return String(value);
  if (name.endsWith("_m2")) return `${fixed(value, 1)}${kThin}m²`;
  if (name.endsWith("_mps")) return `${fixed(value, 2)}${kThin}m/s`;
  if (name === "along_m") return length(Math.abs(value)); // ahead or behind: the wording says both
  if (name.endsWith("_m")) return length(value);
  if (name.endsWith("_rad")) return deg(value, 2);
  if (name.endsWith("_s")) return age(value);
  if (name.endsWith("_kg")) return mass(value);
  if (name.endsWith("_n")) return `${fixed(value / 1000, 1)}${kThin}kN`;
  if (name.endsWith("_percent")) return `${fixed(value, 0)}${kThin}%`;
  return Number.isInteger(value) ? String(value) : fixed(value, 2);
}

// Parameters that are themselves codes: the cause of needs_person, the motion mode, a state.
const kCodes: Readonly<Record<string, string>> = {
  cause: "reasons:",
  mode: "words:mode.",
  motion_mode: "words:mode.",
  state: "words:job.",
  level: "words:integration.",
  type: "faults:",
  fault: "faults:",
};

/** A vehicle's "code: prose in its own language": the code has words here, or it is left out. */
function whyText(value: string, t: Translate): string | undefined {
  const code = /^([a-z][a-z0-9_]*)(: |$)/.exec(value);
  if (code === null) return value;
  const text = words(t, `reasons:${code[1]}`, {});
  if (text !== undefined && !text.includes("{{")) return text;
  return code[2] === "" ? value.replaceAll("_", " ") : undefined;
}

function shown(params: Params, t: Translate): Record<string, string> {
  const values: Record<string, string> = {};
  for (const [name, value] of Object.entries(params)) {
    if (value === "") continue;
    if (name === "why" && typeof value === "string") {
      const why = whyText(value, t);
      if (why !== undefined) values[name] = why;
      continue;
    }
    const prefix = kCodes[name];
    if (name === "state" && value === "Aborted") {
      values[name] = t("words:job.given_up"); // a refusal does not tell which of the two it was
      continue;
    }
    const named =
      prefix === undefined || typeof value !== "string"
        ? undefined
        : prefix === "faults:"
          ? faultText(value, t)
          : words(t, `${prefix}${value}`, {});
    values[name] = named !== undefined && !named.includes("{{") ? named : paramText(name, value);
  }
  return values;
}

/**
 * {code, params} as a sentence. A code this version does not know is shown with its parameters rather than
 * hidden: the server may be newer than the page.
 */
export function reasonText(reason: Reason, t: Translate): string {
  const values = shown(reason.params, t);
  const text = sentence(t, reason.code, values);
  if (text !== undefined) return text;
  const rest = Object.entries(values).map(([name, value]) => `${name.replaceAll("_", " ")} ${value}`);
  const head = t("reasons:unnamed", { code: reason.code.replaceAll("_", " ") });
  return rest.length === 0 ? head : `${head} (${rest.join(", ")})`;
}

/** A refused request in words; the server's own sentence only where the code is unknown here. */
export function problemText(problem: { code: string; params: Params; detail: string }, t: Translate): string {
  return sentence(t, problem.code, shown(problem.params, t)) ?? (problem.detail || reasonText(problem, t));
}
