// Plants other than those that are shipped: what truly lies on the floor, where that is not what the survey says; a hall without lanes.
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Plant } from "./processes.mjs";

/** A shipped plant whose stations stand on free floor, as a file. */
export function withoutLanes(name) {
  const { model } = new Plant(name);
  model.roadmap = { nodes: [], edges: [] };
  for (const station of model.stations) delete station.node;
  const file = join(mkdtempSync(join(tmpdir(), "pulseline-plant-")), "free-floor.json");
  writeFileSync(file, JSON.stringify(model));
  return file;
}

/** The system's plant, changed by `change` in place, as a file for agents: `startAgent(id, { world })`. */
export function writeWorld(system, change) {
  const world = JSON.parse(readFileSync(system.plant.file, "utf8"));
  for (const hall of world.halls) delete hall.occupancy_yaml; // it would have to lie beside the file
  change(world);
  const file = join(system.directory, "world.json");
  writeFileSync(file, JSON.stringify(world));
  return file;
}
