// What truly lies on the floor, where that is not what the plant's survey says.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

/** The system's plant, changed by `change` in place, as a file for agents: `startAgent(id, { world })`. */
export function writeWorld(system, change) {
  const world = JSON.parse(readFileSync(system.plant.file, "utf8"));
  for (const hall of world.halls) delete hall.occupancy_yaml; // it would have to lie beside the file
  change(world);
  const file = join(system.directory, "world.json");
  writeFileSync(file, JSON.stringify(world));
  return file;
}
