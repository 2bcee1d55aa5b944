import { describe, expect, it } from "vitest";
import { listed, noNames, sentence, type Names, type Translate } from "./sentence";

const kCatalogue: Readonly<Record<string, string>> = {
  "x:held": "Held by {{vehicle}} at {{station}} since {{held_s}}",
  "x:held_b": "Held by {{vehicle}}",
  "x:held_c": "Held",
  "x:told": "{{by}}: {{why}}",
  "x:told_b": "{{by}} says no more",
  "x:cause": "Because: {{cause}}",
  "x:failed": "{{action}} failed",
  "x:set": "{{flag}}, {{mode}}, {{state}}, {{fault}}",
  "reasons:server_restarted": "the server began anew",
  "reasons:with_hole": "holes {{n}}",
  "words:mode.lateral": "Lateral",
  "words:job.given_up": "Given up",
  "words:action.pick": "Take over {{load}}",
  "words:action.pick_b": "Take over",
  "faults:wheel_fault": "a broken wheel",
  "words:join": "; ",
};
const t: Translate = (key, values) => kCatalogue[key] ?? String(values?.["defaultValue"] ?? key);
const names: Names = {
  ...noNames,
  vehicle: (id) => (id === "v1" ? "TP-01" : undefined),
  station: (id) => (id === "s7" ? "7" : undefined),
  actor: (id) => (id === "token:1" ? "a program" : undefined),
};

describe("sentence", () => {
  it.each<[string, Record<string, string | number | boolean>, string | undefined]>([
    ["x:held", { vehicle: "v1", station: "s7", held_s: 4 }, "Held by TP-01 at 7 since 4.0\u00a0s"],
    ["x:held", { vehicle: "v9" }, "Held by v9"],
    ["x:held", { vehicle: "" }, "Held"],
    [
      "x:told",
      { by: "token:1", why: "server_restarted: Prose of a vehicle." },
      "a program: the server began anew",
    ],
    ["x:told", { by: "s7", why: "brand_new: Prose of a vehicle." }, "7 says no more"],
    ["x:cause", { cause: "with_hole" }, "Because: with_hole"],
    ["x:failed", { action: "pick" }, "Take over failed"],
    ["x:failed", { action: "polish" }, "polish failed"],
    [
      "x:set",
      { flag: true, mode: "lateral", state: "Aborted", fault: "wheelFault" },
      "\u2713, Lateral, Given up, a broken wheel",
    ],
    ["x:held", { vehicle: "{{station}}" }, "Held by {{station}}"],
    ["x:nothing", { vehicle: "v1" }, undefined],
  ])("%s of %j", (key, params, text) => expect(sentence(key, params, names, t)).toBe(text));
});

it("lists what a code carries that has no wording, without the unit in its name", () => {
  expect(listed({ vehicle: "v1", gap_m: 0.2, empty: "" }, names, t)).toBe("vehicle TP-01; gap 0.20\u00a0m");
});
