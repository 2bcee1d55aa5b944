// Small halls for the platform of pulse-line, for tests that need a particular floor.
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Client } from "./client.mjs";
import { laneCodes } from "../tools/lane_codes.mjs";
import { ROOT, System } from "./processes.mjs";

const CAMERA_M = 5.346; // ahead of and behind the platform's centre

/** File of a hall of resting stations `name: [x, y, number]` and plain nodes `name: [x, y]`, joined by two-way lanes "a-b"; with codes on these, as
 *  a plant has them. */
export function plantOf({ spots, lanes, vehicles, obstacles = [], chargers = [], battery }) {
  const model = JSON.parse(readFileSync(join(ROOT, "db/plants/pulse-line.json"), "utf8"));
  const hall = model.halls[0];
  delete hall.occupancy_yaml;
  hall.outline = [[0, 0], [160, 0], [160, 120], [0, 120]].map(([x_m, y_m]) => ({ x_m, y_m }));
  const stations = Object.entries(spots).filter(([, spot]) => spot.length === 3).sort(([, a], [, b]) => a[2] - b[2]);
  const code = (number, side) => `ST${String(number).padStart(2, "0")}-${side}`;
  Object.assign(model, {
    id: "meeting", name: "Meeting",
    areas: obstacles.map(([x0, y0, x1, y1], i) => ({
      id: `rack-${i + 1}`, kind: "obstacle", name: `Rack ${i + 1}`, hall: hall.id, outline: [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(([x_m, y_m]) => ({ x_m, y_m })),
    })),
    stations: stations.map(([name, [x_m, y_m, number]]) => ({
      id: `s${number}`, number, name, hall: hall.id, pose: { x_m, y_m, heading_rad: 0 }, node: name, resting_place: true, charger: chargers.includes(number),
      tolerance: { shape: "box", dx_m: 0.025, dy_m: 0.025, dheading_rad: 0.0035 }, markers: [code(number, "F"), code(number, "B")], vehicle_types: ["transport-platform"],
    })),
    markers: stations.flatMap(([, [x_m, y_m, number]]) => [["F", CAMERA_M], ["B", -CAMERA_M]].map(([side, ahead]) => ({
      id: code(number, side), kind: "qr", payload: code(number, side), size_m: 0.06, hall: hall.id,
      pose: { x_m: x_m + ahead, y_m, heading_rad: 0 }, sigma_xy_m: 0.0001, sigma_heading_rad: 0.0005,
    }))),
    roadmap: {
      nodes: Object.entries(spots).map(([id, [x_m, y_m]]) => ({ id, hall: hall.id, position: { x_m, y_m } })),
      edges: lanes.flatMap((lane) => { const [a, b] = lane.split("-"); return [{ id: `${a}.${b}`, from: a, to: b }, { id: `${b}.${a}`, from: b, to: a }]; }),
    },
    loads: [],
    vehicles: vehicles.map((station, i) => ({
      id: `V${i + 1}`, type: "transport-platform", manufacturer: "pulseline", serial_number: `V${i + 1}`, name: `V${i + 1}`, home: `s${station}`,
    })),
  });
  model.markers.push(...laneCodes(model));
  if (battery) for (const type of model.vehicle_types) type.battery = battery;
  const file = join(mkdtempSync(join(tmpdir(), "pulseline-plant-")), "meeting.json");
  writeFileSync(file, JSON.stringify(model));
  return file;
}

/** Server and one agent a vehicle up and ready in the hall; `agentOptions(id)`: what an agent gets besides. */
export async function startHall(t, plant, agentOptions = () => ({})) {
  const system = await System.create(plantOf(plant));
  t.after(() => system.stop());
  const ids = plant.vehicles.map((_, i) => `V${i + 1}`);
  system.prepareVehicles(ids);
  await system.startServer();
  const client = new Client(system.url, system.apiToken);
  ids.forEach((id, i) => system.startAgent(id, { seed: i + 1, sensing: "analytic", ...agentOptions(id) }));
  await Promise.all(ids.map((id) => client.untilReady(id)));
  return { system, client, ids };
}
