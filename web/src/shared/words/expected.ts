/** When something is expected, seen from now. A time that has passed is not expected any more: it is late. */
export type Expected = { kind: "none" } | { kind: "in"; s: number } | { kind: "late"; s: number };

export function expectedIn(at: string | undefined, nowMs: number): Expected {
  const left = at === undefined ? NaN : (Date.parse(at) - nowMs) / 1000;
  if (Number.isNaN(left)) return { kind: "none" };
  // Half a second is less than two clocks differ by.
  return left > -0.5 ? { kind: "in", s: Math.max(1, Math.ceil(left)) } : { kind: "late", s: -left };
}
