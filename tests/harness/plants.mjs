// Variants of demo plants, as files of their own.
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { ROOT } from "./processes.mjs";

/** The demo plant `name` as `change(model)` leaves it; the way to its file. Walls are as its outlines say. */
export function variantOf(name, change) {
  const model = JSON.parse(readFileSync(join(ROOT, `db/plants/${name}.json`), "utf8"));
  for (const hall of model.halls) delete hall.occupancy_yaml;
  change(model);
  const file = join(mkdtempSync(join(tmpdir(), "pulseline-plant-")), `${name}.json`);
  writeFileSync(file, JSON.stringify(model));
  return file;
}

/** The pulse line in the morning: its only aircraft hangs at `station`, and the platform is empty. */
export function morning(station, support = { height_m: 0.12 }) {
  return variantOf("pulse-line", (model) => {
    const there = model.stations.find(({ number }) => number === station);
    there.support = support;
    const { vehicle, ...aircraft } = model.loads.find(({ vehicle }) => vehicle !== undefined);
    model.loads = [{ ...aircraft, station: there.id }];
  });
}
