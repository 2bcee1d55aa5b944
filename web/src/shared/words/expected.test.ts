import { expect, it } from "vitest";
import { expectedIn } from "./expected";

const kNow = Date.parse("2026-11-24T20:15:00Z");
const at = (s: number) => new Date(kNow + s * 1000).toISOString();

it.each<[string, string | undefined, object]>([
  ["nothing is expected", undefined, { kind: "none" }],
  ["what is no time is none", "soon", { kind: "none" }],
  ["a minute ahead", at(60), { kind: "in", s: 60 }],
  ["never 0:00", at(0.2), { kind: "in", s: 1 }],
  ["clocks differ a little", at(-0.4), { kind: "in", s: 1 }],
  ["past", at(-80), { kind: "late", s: 80 }],
])("%s", (_, when, expected) => expect(expectedIn(when, kNow)).toEqual(expected));
