import type { Vehicle } from "@/shared/api/types";
import { alarmOf, silent } from "./attention";
import { haltOf } from "./pause";

/** Since when a vehicle does what it does. Not exact: at least since then, it was so when this page first saw it. */
export interface Since {
  doing: string;
  atMs: number;
  exact: boolean;
}

/** What counts as one doing: whoever waits goes on waiting when only the cause changes. */
function doingOf(v: Vehicle): string {
  const alarm = alarmOf(v);
  if (alarm !== undefined && alarm.priority !== "low") return alarm.kind;
  return haltOf(v) === "none" ? v.activity : "paused";
}

/** What this page has seen of it; `seen`: the change itself came in, it was not found after a gap. */
export function sinceSeen(known: Since | undefined, v: Vehicle, nowMs: number, seen: boolean): Since {
  const doing = doingOf(v);
  return known?.doing === doing ? known : { doing, atMs: nowMs, exact: seen };
}

/** The same from what the server tells, where it does, else from what this page has seen. */
export function sinceOf(v: Vehicle, known: Since | undefined): Omit<Since, "doing"> | undefined {
  const told = v.paused
    ? v.pause?.at
    : silent(v)
      ? v.last_heard_at
      : v.activity === "moving"
        ? v.leg?.started_at
        : undefined;
  const atMs = told === undefined ? NaN : Date.parse(told);
  return Number.isNaN(atMs) ? known : { atMs, exact: true };
}
