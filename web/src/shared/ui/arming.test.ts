import { expect, it } from "vitest";
import { armedLeftMs, isLapsed, isSameTap, kArmMs, kDoubleTapMs } from "./arming";

it.each([
  [0, true, false, 8000],
  [kDoubleTapMs - 1, true, false, 7601],
  [kDoubleTapMs, false, false, 7600],
  [kArmMs - 1, false, false, 1],
  [kArmMs, false, true, 0],
  [kArmMs + 5000, false, true, 0],
  [-100, true, false, 8000],
])("%s ms after arming", (passed, sameTap, lapsed, left) => {
  expect([
    isSameTap(1000, 1000 + passed),
    isLapsed(1000, 1000 + passed),
    armedLeftMs(1000, 1000 + passed),
  ]).toEqual([sameTap, lapsed, left]);
});
