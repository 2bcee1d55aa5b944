import { readdirSync, readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";

import rawEn from "@/shared/words/catalogs/faults.en.json";
import rawZh from "@/shared/words/catalogs/faults.zh.json";
import { faultKey } from "@/shared/words/faults";

// VDA 5050's names of what an error refers to, which are no faults.
const kReferences = new Set(["actionId", "nodeId", "orderId", "orderUpdateId"]);

/** Every name of the vehicle's own program that is written as VDA 5050 writes types of errors. */
function saidByVehicles(): string[] {
  const root = new URL("../../../../", import.meta.url);
  const sources = ["core/onboard/", "server/agent/"].flatMap((folder) =>
    readdirSync(new URL(folder, root), { recursive: true, encoding: "utf8" })
      .filter((name) => name.endsWith(".cpp"))
      .map((name) => readFileSync(new URL(folder + name, root), "utf8")),
  );
  const names = sources.flatMap((text) => text.match(/(?<=")[a-z]+(?:[A-Z][a-z]+)+(?=")/g) ?? []);
  return [...new Set(names)].filter((name) => !kReferences.has(name)).sort();
}

describe("faults", () => {
  const said = saidByVehicles();
  it("are named in the vehicle's program", () => {
    expect(said).toEqual(expect.arrayContaining(["poseUncertain", "codeRefused", "wheelSlip"]));
  });
  it.each(said)("%s has words in both languages", (type) => {
    for (const words of [rawEn, rawZh] as Record<string, string>[]) {
      expect(words[faultKey(type)]).toMatch(/\S/);
    }
  });
});
