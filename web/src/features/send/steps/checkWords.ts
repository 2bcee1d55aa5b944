import type { Params, Reason } from "@/shared/api/types";
import type { ShownCheck } from "./wayChecks";
import { countChecks } from "../preview/preview";
import { degrees, millimetres } from "@/shared/words/format";
import { listed, sentence, type Names, type Translate } from "@/shared/words/sentence";

/** Adds what the wording needs and the server does not send as such: shares as percent, reasons in words. */
function wordParams(check: ShownCheck, reasonOf: (reason: Reason) => string): Params {
  const params: Params = { ...check.params };
  const share = (from: string, to: string) => {
    const value = params[from];
    if (typeof value === "number") params[to] = value * 100;
  };
  share("unbalance", "unbalance_percent");
  share("limit", "limit_percent");
  const { dx_m, dy_m, dheading_rad } = params;
  if (typeof dx_m === "number" && typeof dy_m === "number" && typeof dheading_rad === "number") {
    const mm = (v: number) => `${millimetres(v, { decimals: 1, sign: true })} mm`;
    params.offset = `${mm(dx_m)}, ${mm(dy_m)}, ${degrees(dheading_rad, { sign: true })}°`;
  }
  if (typeof params.reason === "string")
    params.because = reasonOf({ code: params.reason, params: check.params });
  return params;
}

/** One check in words: the wording of its result, or all its parameters when there is none. */
export function checkWords(
  check: ShownCheck,
  names: Names,
  t: Translate,
  reasonOf: (reason: Reason) => string,
): string {
  const params = wordParams(check, reasonOf);
  const total = params.total_n;
  const isEmpty =
    check.code === "load" && check.result === "pass" && typeof total === "number" && total < 1000;
  const key = isEmpty ? "send:checks.pass.load_empty" : `send:checks.${check.result}.${check.code}`;
  return sentence(key, params, names, t) ?? listed(check.params, names, t);
}

const kSumOrder = ["fail", "wait", "note", "pass"] as const;

/** "1 to wait for, 1 to note, 10 pass": the worst first, nothing counted twice, and "All 12 pass" only where all do. */
export function checksSummary(
  checks: readonly ShownCheck[],
  say: (key: string, params?: Params) => string,
): string {
  const sum = countChecks(checks);
  if (sum.pass === checks.length) return say("checks.sum.all", { count: sum.pass });
  const parts = kSumOrder.filter((part) => sum[part] > 0);
  return parts.map((part) => say(`checks.sum.${part}`, { count: sum[part] })).join(say("words.join"));
}
