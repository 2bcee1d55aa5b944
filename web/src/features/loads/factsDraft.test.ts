import { describe, expect, it } from "vitest";
import type { Load } from "@/shared/api/types";
import { draftOf, emptyDraft, pointedAt, readDraft, type FactsDraft } from "./factsDraft";

const known: Load = {
  id: "A-1",
  name: "Trainer one",
  names: { zh: "教练机一号" },
  kind: "product",
  model: "T-5",
  mass_kg: 18350.5,
  centre: { x_m: -0.057, y_m: 0.0123 },
  outline: [
    { x_m: -1, y_m: 0 },
    { x_m: 1, y_m: 1 },
    { x_m: 1, y_m: -1 },
  ],
  vehicle_types: ["platform"],
  carriers: ["platform"],
  registered_at: "2026-11-29T20:00:00Z",
  registered_by: "ann",
  station: 7,
  since: "2026-11-29T20:00:00Z",
  by: "ann",
};
const read = (part: Partial<FactsDraft>) => readDraft({ ...emptyDraft, id: "A-9", ...part });
const factsOf = (part: Partial<FactsDraft>) => {
  const result = read(part);
  return result.kind === "facts" ? result.facts : result;
};

describe("what is told of a new load", () => {
  it("is all that was typed, and nothing else", () =>
    expect(
      read({
        id: " A-9 ",
        name: " Trainer nine ",
        model: "T-5",
        mass_kg: "18350",
        ahead_mm: "-50",
        left_mm: "12.5",
        types: ["platform"],
      }),
    ).toEqual({
      kind: "facts",
      id: "A-9",
      facts: {
        name: "Trainer nine",
        kind: "airframe",
        model: "T-5",
        mass_kg: 18350,
        centre: { x_m: -0.05, y_m: 0.0125 },
        vehicle_types: ["platform"],
      },
    }));
  it("is little where little was typed: not weighed, over the middle, for whoever has brackets", () =>
    expect(factsOf({ name: "  ", model: " " })).toEqual({
      kind: "airframe",
      mass_kg: 0,
      centre: { x_m: 0, y_m: 0 },
    }));
  it.each([
    ["18350.5", 18350.5],
    ["350,5", 350.5],
    ["18,350", 18350],
    ["18 350", 18350],
    ["0", 0],
    ["1000000", 1_000_000],
  ])("has a mass of %s", (mass_kg, is) => expect(factsOf({ mass_kg })).toMatchObject({ mass_kg: is }));
  it.each([
    ["12,5", 0.0125],
    ["\u221230", -0.03],
    ["+7", 0.007],
  ])("has its centre %s mm ahead", (ahead_mm, x_m) =>
    expect(factsOf({ ahead_mm })).toMatchObject({ centre: { x_m, y_m: 0 } }),
  );
});

it.each<[string, Partial<FactsDraft>, string]>([
  ["without an id", { id: "  " }, "id"],
  ["with less than no mass", { mass_kg: "-1" }, "mass_kg"],
  ["heavier than anything", { mass_kg: "1000000.1" }, "mass_kg"],
  ["of a mass that is no number", { mass_kg: "18 t" }, "mass_kg"],
  ["with no number ahead", { ahead_mm: "a bit" }, "ahead_mm"],
  ["with no number to the left", { left_mm: "-" }, "left_mm"],
])("tells nothing of a load %s", (_, part, field) => expect(read(part)).toEqual({ kind: "wrong", field }));

describe("what is told anew of a known load", () => {
  const { name, names, kind, model, mass_kg, centre, outline, vehicle_types } = known;
  const all = { name, names, kind, model, mass_kg, centre, outline, vehicle_types };

  it("is the same where nothing was changed", () =>
    expect(readDraft(draftOf(known), known)).toEqual({ kind: "facts", id: "A-1", facts: all }));
  it("keeps all but its mass when it has been weighed", () =>
    expect(readDraft({ ...draftOf(known), mass_kg: "18410" }, known)).toEqual({
      kind: "facts",
      id: "A-1",
      facts: { ...all, mass_kg: 18410 },
    }));
  it("leaves its id as it is, whatever the form says", () =>
    expect(readDraft({ ...draftOf(known), id: "B-2" }, known)).toMatchObject({ id: "A-1" }));
  it("forgets what was emptied", () =>
    expect(readDraft({ ...draftOf(known), name: "", model: "", mass_kg: "", types: [] }, known)).toEqual({
      kind: "facts",
      id: "A-1",
      facts: { names, kind, mass_kg: 0, centre, outline },
    }));
  it.each([0.1 + 0.2, 0.057, -1.005, 0.000_001_5, 12.345_678_901])("reads %s m again as it was", (x_m) => {
    const load = { ...known, centre: { x_m, y_m: -x_m } };
    const result = readDraft(draftOf(load), load);
    expect(result.kind === "facts" && result.facts.centre?.x_m).toBeCloseTo(x_m, 11);
    expect(result.kind === "facts" && result.facts.centre?.y_m).toBeCloseTo(-x_m, 11);
  });
});

it.each<[string | undefined, readonly string[]]>([
  ["/mass_kg", ["mass_kg"]],
  ["/centre", ["ahead_mm", "left_mm"]],
  ["/centre/x_m", ["ahead_mm", "left_mm"]],
  ["/vehicle_types/1", ["types"]],
  ["/name", ["name"]],
  ["/outline", []],
  ["/constructor", []],
  ["", []],
  [undefined, []],
])("a refusal of %s points at %j", (pointer, fields) => expect(pointedAt(pointer)).toEqual(fields));
