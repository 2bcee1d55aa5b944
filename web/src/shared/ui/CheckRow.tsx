import type { ReactNode } from "react";
import { age } from "@/shared/words/format";
import { StatusSymbol } from "./Icon";
import "./CheckRow.css";

export type CheckResult = "pass" | "note" | "fail";

export interface CheckRowProps {
  result: CheckResult;
  name: string;
  /** Result with its number and limit. */
  value: ReactNode;
  ageS?: number | undefined;
  /** A failed check that may hurt somebody is critical, else high. */
  critical?: boolean;
  /** A note for which the order would wait: amber, as in the command bar. */
  waits?: boolean;
  /** What it says is too old to be believed: nothing passes any more. */
  stale?: boolean;
}

const kOrder: Record<CheckResult, number> = { fail: 0, note: 1, pass: 2 };
/** Failed ones first, then notes; the order within stays. */
export function sortChecks<T extends { result: CheckResult }>(checks: readonly T[]): T[] {
  return [...checks].sort((a, b) => kOrder[a.result] - kOrder[b.result]);
}

export function CheckRow({ result, name, value, ageS, critical, waits, stale }: CheckRowProps) {
  const note = waits ? "a-2" : "a-3";
  const symbol =
    result === "pass" ? (stale ? "s-stale" : "c-ok") : result === "note" ? note : critical ? "a-1" : "a-2";
  const wash =
    result === "pass" ? "" : result === "note" && !waits ? "warn" : critical && !waits ? "crit" : "fail";
  return (
    <div className={`chk ${wash} ${stale ? "old" : ""}`} data-result={result} data-stale={stale}>
      <StatusSymbol name={symbol} className={result === "pass" ? "quiet" : ""} />
      <b>{name}</b>
      <span className="v">{value}</span>
      <span className="cap">{ageS === undefined ? "" : age(ageS)}</span>
    </div>
  );
}
