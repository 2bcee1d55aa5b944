import type { CommandProgress } from "./command";
import type { Asked } from "./useCommand";

/** What has been stored and is not reported after this long has not worked. */
export const kConfirmMs = 15_000;
/** How long the confirmation stays before the button is ready for the next command. */
export const kShownMs = 2500;

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
