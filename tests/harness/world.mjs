// What truly lies on the floor, where that is not what the plant's survey says.
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";

/** The system's plant, changed by `change` in place, as a file for agents: `startAgent(id, { world })`. */
export function writeWorld(system, change) {
  const world = JSON.parse(readFileSync(system.plant.file, "utf8"));
  for (const hall of world.halls) {
    if (hall.occupancy_yaml) hall.occupancy_yaml = join(dirname(system.plant.file), hall.occupancy_yaml);
  }
  change(world);
  const file = join(system.directory, "world.json");
  writeFileSync(file, JSON.stringify(world));
  return file;
}
