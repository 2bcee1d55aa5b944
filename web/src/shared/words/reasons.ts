import type { Params, Reason } from "@/shared/api/types";
import { listed, noNames, sentence, type Names, type Translate } from "./sentence";

/**
 * {code, params} as a sentence. A code this version does not know is shown with its parameters rather than
 * hidden: the server may be newer than the page.
 */
export function reasonText(reason: Reason, t: Translate, names: Names = noNames): string {
  const text = sentence(`reasons:${reason.code}`, reason.params, names, t);
  if (text !== undefined) return text;
  const head = t("reasons:unnamed", { code: reason.code.replaceAll("_", " ") });
  const rest = listed(reason.params, names, t);
  return rest === "" ? head : `${head} (${rest})`;
}

/** A refused request in words; the server's own sentence only where the code is unknown here. */
export function problemText(
  problem: { code: string; params: Params; detail: string },
  t: Translate,
  names: Names = noNames,
): string {
  const text = sentence(`reasons:${problem.code}`, problem.params, names, t);
  return text ?? (problem.detail || reasonText(problem, t, names));
}
