import type { CommandProgress } from "./command";
import type { Asked } from "./useCommand";

/** What has been stored and is not reported after this long has not worked. */
export const kConfirmMs = 15_000;
/** How long the confirmation stays before the button is ready for the next command. */
export const kShownMs = 2500;

/** A platform that brakes and lets go of its order takes some seconds; what takes so long is stuck. */
export const kStandMs = 30_000;

/** What is under way ends, too: as timed out. */
export function overdue(
  progress: CommandProgress,
  sinceMs: number | undefined,
  nowMs: number,
  timedOut: { what: string; next: string },
): CommandProgress {
  const late = progress.kind === "under_way" && sinceMs !== undefined && nowMs - sinceMs >= kStandMs;
  return late ? { kind: "timed_out", ...timedOut } : progress;
}

/** What a command's button shows, from what was asked and when it was reported as done. */
export function outcome(
  asked: Asked,
  doneMs: number | undefined,
  nowMs: number,
  who: string,
  timedOut: { what: string; next: string },
): CommandProgress {
  switch (asked.kind) {
    case "requested":
      return { kind: "requested", atMs: asked.atMs };
    case "stored":
      if (doneMs !== undefined) return { kind: "confirmed", by: who, afterS: (doneMs - asked.atMs) / 1000 };
      return nowMs - asked.atMs < kConfirmMs
        ? { kind: "accepted", waitingFor: who }
        : { kind: "timed_out", ...timedOut };
    case "failed":
    case "idle":
      return { kind: "ready" };
  }
}
