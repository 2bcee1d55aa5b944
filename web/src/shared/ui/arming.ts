// The one rule of every command of two steps: armed by a press, given by the next one while it is armed, or by holding.

/** How long a command stays armed. */
export const kArmMs = 8000;
/** Holding this long arms and gives at once. */
export const kHoldMs = 1500;
/** A second press this soon is the same tap, not a decision. */
export const kDoubleTapMs = 400;

export const isSameTap = (beforeMs: number, nowMs: number) => nowMs - beforeMs < kDoubleTapMs;
export const isLapsed = (armedAtMs: number, nowMs: number) => nowMs - armedAtMs >= kArmMs;

/** Time left of an arming, never more than the whole: a clock may have been set back. */
export const armedLeftMs = (armedAtMs: number, nowMs: number) =>
  Math.min(kArmMs, Math.max(0, armedAtMs + kArmMs - nowMs));
