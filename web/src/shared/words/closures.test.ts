import { expect, it } from "vitest";
import { closureKey } from "./closures";

it.each([
  ["Work", "work"],
  ["施工", "work"],
  ["Wet floor", "spill"],
  ["Wet paint", undefined],
])("%j is %j", (name, key) => expect(closureKey(name)).toBe(key));
