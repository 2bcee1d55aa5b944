import type { Vehicle } from "@/shared/api/types";

export type Level = Vehicle["integration"];
/** From out to in. */
export const levels: readonly Level[] = ["ignore", "notice", "respect", "utilise"];

export function holdsFloor(level: Level): boolean {
  return level === "respect" || level === "utilise";
}

/** Whether the change may be asked for; else the word that says why not. */
export function canApply(now: Level, wanted: Level, offFloor: boolean): "yes" | "same" | "confirm_first" {
  if (now === wanted) return "same";
  return holdsFloor(now) && !holdsFloor(wanted) && !offFloor ? "confirm_first" : "yes";
}
