import { expect, it } from "vitest";
import { actorText } from "./actor";

it.each([
  ["anna", "anna"],
  ["token:36afca8a966d", "words:program 36afca"],
  ["", ""],
])("%j is said as %j", (actor, text) =>
  expect(actorText(actor, (key, values) => `${key} ${String(values?.["id"])}`)).toBe(text),
);
