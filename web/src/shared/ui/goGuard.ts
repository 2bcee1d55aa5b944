/** For so long after a press on what stops, nothing that sets in motion takes a press. */
export const kGuardMs = 3000;
/** Presses closer than this are still the same frightened finger. */
export const kCalmMs = 800;

/**
 * Spans all commands of the page: whoever presses Pause again and again must never press a Resume or a
 * Start that has come under the finger meanwhile. A press that was refused keeps the guard up until the
 * finger is calm.
 */
export class GoGuard {
  private stoppedMs = -Infinity;
  private refusedMs = -Infinity;

  /** A press on something that stops, whether or not it was needed any more. */
  stopPressed(nowMs: number): void {
    this.stoppedMs = nowMs;
  }

  /** Whether a press on something that sets in motion counts. */
  takes(nowMs: number): boolean {
    if (nowMs - this.stoppedMs >= kGuardMs && nowMs - this.refusedMs >= kCalmMs) return true;
    this.refusedMs = nowMs;
    return false;
  }
}

export const goGuard = new GoGuard();
