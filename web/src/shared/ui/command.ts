import { isLapsed, isSameTap } from "./arming";

/** How far a command has come. Only what the server or the vehicle said, never what we hope. */
export type CommandProgress =
  | { kind: "ready" }
  | { kind: "requested"; atMs: number } // performance.now()
  | { kind: "accepted"; waitingFor: string }
  | { kind: "confirmed"; by: string; afterS: number }
  /** Takes no press: what was asked for is under way, or holds. */
  | { kind: "under_way" | "holds"; title: string; small: string }
  | { kind: "timed_out"; what: string; next: string };

/** What the command is for: a guard that spans all of them keeps the two apart (goGuard). */
export type Direction = "stop" | "go";

/** What a press does, given the state the button is in. Pure, so that taps can be tested. */
export type Press = { kind: "arm" } | { kind: "run" } | { kind: "none" };

export function press(
  progress: CommandProgress,
  armedAtMs: number | undefined,
  lastRunMs: number | undefined,
  nowMs: number,
  twoStep: boolean,
): Press {
  if (progress.kind !== "ready" && progress.kind !== "timed_out") return { kind: "none" };
  if (lastRunMs !== undefined && isSameTap(lastRunMs, nowMs)) return { kind: "none" };
  if (!twoStep) return { kind: "run" };
  if (armedAtMs === undefined || isLapsed(armedAtMs, nowMs)) return { kind: "arm" };
  return isSameTap(armedAtMs, nowMs) ? { kind: "none" } : { kind: "run" };
}
