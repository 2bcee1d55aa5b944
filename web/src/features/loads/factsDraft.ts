import type { Load, LoadFacts, LoadKind } from "@/shared/api/types";
import { parseNumber } from "@/shared/words/parseNumber";

export const kKinds: readonly LoadKind[] = ["airframe", "product", "instrument"];
export const kLongestId = 64;
export const kLongestName = 200;
const kMost_kg = 1_000_000;

/** What a person has typed of a load. Its centre of gravity is told from the middle of the brackets. */
export interface FactsDraft {
  id: string;
  name: string;
  kind: LoadKind;
  model: string;
  mass_kg: string;
  ahead_mm: string;
  left_mm: string;
  /** Vehicle types that may carry it; none: whoever has brackets. */
  types: readonly string[];
}

export const emptyDraft: FactsDraft = {
  id: "",
  name: "",
  kind: "airframe",
  model: "",
  mass_kg: "",
  ahead_mm: "",
  left_mm: "",
  types: [],
};

// Twelve digits: free of the dust of multiplying, and read again the same.
const inMillimetres = (value_m: number) => String(Number((value_m * 1000).toPrecision(12)));

/** A load as a person would have typed it. */
export function draftOf(load: Load): FactsDraft {
  return {
    id: load.id,
    name: load.name === load.id ? "" : load.name,
    kind: load.kind,
    model: load.model ?? "",
    mass_kg: load.mass_kg === 0 ? "" : String(load.mass_kg),
    ahead_mm: inMillimetres(load.centre.x_m),
    left_mm: inMillimetres(load.centre.y_m),
    types: load.vehicle_types ?? [],
  };
}

export type FactsResult =
  | { kind: "facts"; id: string; facts: LoadFacts }
  | { kind: "wrong"; field: "id" | "mass_kg" | "ahead_mm" | "left_mm" };

const numberOf = (text: string) => (text.trim() === "" ? 0 : parseNumber(text));

/** What the server is told. It forgets what is left out: of a known load all goes with it that the form does not show. */
export function readDraft(draft: FactsDraft, known?: Load): FactsResult {
  const id = known?.id ?? draft.id.trim();
  if (id === "") return { kind: "wrong", field: "id" };
  const mass_kg = numberOf(draft.mass_kg);
  if (mass_kg === undefined || mass_kg < 0 || mass_kg > kMost_kg) return { kind: "wrong", field: "mass_kg" };
  const ahead_mm = numberOf(draft.ahead_mm);
  if (ahead_mm === undefined) return { kind: "wrong", field: "ahead_mm" };
  const left_mm = numberOf(draft.left_mm);
  if (left_mm === undefined) return { kind: "wrong", field: "left_mm" };
  const [name, model] = [draft.name.trim(), draft.model.trim()];
  const facts: LoadFacts = {
    ...(name !== "" && { name }),
    ...(known?.names && { names: known.names }),
    kind: draft.kind,
    ...(model !== "" && { model }),
    mass_kg,
    centre: { x_m: ahead_mm / 1000, y_m: left_mm / 1000 },
    ...(known?.outline && { outline: known.outline }),
    ...(draft.types.length > 0 && { vehicle_types: [...draft.types] }),
  };
  return { kind: "facts", id, facts };
}

const kPointedAt: Readonly<Record<string, readonly (keyof FactsDraft)[]>> = {
  name: ["name"],
  kind: ["kind"],
  model: ["model"],
  mass_kg: ["mass_kg"],
  centre: ["ahead_mm", "left_mm"],
  vehicle_types: ["types"],
};

/** The fields of the form that a refusal is about: "/centre/x_m". */
export function pointedAt(pointer: string | undefined): readonly (keyof FactsDraft)[] {
  const name = pointer?.split("/")[1] ?? "";
  return Object.hasOwn(kPointedAt, name) ? (kPointedAt[name] ?? []) : [];
}
