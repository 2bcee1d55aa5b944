import type { ReactNode } from "react";
import { useTranslation } from "react-i18next";
import { age, number, timeOfDay } from "@/shared/words/format";
import "./Value.css";

/** Freshness of a value. Thresholds as the fleet's: late 2 s, lost 10 s. */
export type Freshness = "live" | "late" | "lost" | "never";
export const kLateS = 2;
export const kLostS = 10;

export function freshness(ageS: number | undefined): Freshness {
  if (ageS === undefined || !Number.isFinite(ageS)) return "never";
  if (ageS >= kLostS) return "lost";
  return ageS >= kLateS ? "late" : "live";
}

export interface ValueProps {
  caption?: string;
  /** Formatted digits; undefined was never received. */
  value: string | undefined;
  unit?: string;
  /** Undefined: the value has no age of its own. "never": never received. */
  ageS?: number | "never" | undefined;
  /** Epoch ms of the value, shown when it is lost. */
  atMs?: number | undefined;
  size?: "lg" | "hero";
  /** Outside its band: amber with the limit in words. */
  outside?: ReactNode;
  boxed?: boolean;
}

export function Value({ caption, value, unit, ageS, atMs, size, outside, boxed }: ValueProps) {
  const { t } = useTranslation();
  const state =
    ageS === undefined
      ? value === undefined
        ? "never"
        : "live"
      : freshness(ageS === "never" ? undefined : ageS);
  const old = state === "late" || state === "lost";
  const classes = [
    boxed && "vb",
    old && "stale",
    state === "lost" && "lost",
    outside !== undefined && "hi",
    "value",
  ];
  const foot =
    outside ??
    (state === "never"
      ? t("value.none")
      : state === "lost" && atMs !== undefined
        ? t("value.last", { time: timeOfDay(atMs) })
        : old
          ? t("value.old", { age: age(ageS as number) })
          : undefined);
  return (
    <div className={classes.filter(Boolean).join(" ")} data-freshness={state}>
      {caption !== undefined && <span className="cap">{caption}</span>}
      <div className={`val ${size ?? ""}`}>
        <b>{state === "never" ? number(undefined) : (value ?? number(undefined))}</b>
        {unit !== undefined && <u>{unit}</u>}
      </div>
      {foot !== undefined && <span className="cap">{foot}</span>}
    </div>
  );
}
