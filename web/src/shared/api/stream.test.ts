import fc from "fast-check";
import { expect, it } from "vitest";
import { parseFrame, retryDelayMs } from "./stream";

it("waits between 0.5 and 10 s before it tries again", () => {
  fc.assert(
    fc.property(fc.nat(60), fc.double({ min: 0, max: 1, noNaN: true }), (attempt, random) => {
      const wait = retryDelayMs(attempt, random);
      expect(wait).toBeGreaterThanOrEqual(500);
      expect(wait).toBeLessThanOrEqual(10_000);
    }),
    { seed: 11 },
  );
  expect(retryDelayMs(20, 1)).toBe(10_000);
});

it.each(["", "{", "null", "[]", '{"type":"unheard"}', '"snapshot"', undefined, 5])("ignores %s", (text) => {
  expect(parseFrame(text)).toBeUndefined();
});

it("takes a known frame", () => {
  expect(parseFrame('{"type":"poses","at":"","poses":[]}')?.type).toBe("poses");
});

it("keeps of a frame with several changes those it knows", () => {
  const frame = parseFrame(
    '{"type":"changes","changes":[{"type":"unheard"},null,{"type":"event","event":{}}]}',
  );
  expect(frame).toEqual({ type: "changes", changes: [{ type: "event", event: {} }] });
  expect(parseFrame('{"type":"changes"}')).toBeUndefined();
});
