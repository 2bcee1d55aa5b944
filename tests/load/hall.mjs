// A server with a hall of vehicles for tests/tools/load, and a look at its process.
import { mkdtempSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { manyVehicles } from "../bench/many_vehicles.mjs";
import { System } from "../harness/processes.mjs";

export const rss_kb = (pid) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, "utf8"))[1]);
export const descriptors = (pid) => readdirSync(`/proc/${pid}/fd`).length;

/** A plant of small carriers in lanes of their own, with a token for each. The last `drivers` of them are left to an agent. */
export async function hall(count, drivers = 0) {
  const file = join(mkdtempSync(join(tmpdir(), "pulseline-load-")), "plant.json");
  writeFileSync(file, JSON.stringify(manyVehicles(count)));
  const system = await System.create(file);
  const tokens = new Map(system.cli(["token", "create", "--all-vehicles"]).trim().split("\n").map((line) => line.split(" ")));
  const { vehicles, stations } = system.plant.model;
  const home = new Map(stations.map((station) => [station.id, station]));
  const reporting = vehicles.slice(0, count - drivers), driving = vehicles.slice(count - drivers);
  const rows = reporting.map((vehicle) => {
    const { pose, node, hall } = home.get(vehicle.home);
    return [vehicle.id, vehicle.manufacturer, vehicle.serial_number, tokens.get(`${vehicle.manufacturer}/${vehicle.serial_number}`), pose.x_m, pose.y_m, node, hall].join(" ");
  });
  // An account has so many streams; a plant's panels have their own, and so has an attacker.
  const programToken = () => system.cli(["token", "create", "--role", "viewer", "--scope", "api"]).trim();
  system.dashboardTokens = Array.from({ length: 4 }, programToken);
  system.attackerToken = system.cli(["token", "create", "--role", "operator", "--scope", "api"]).trim();
  system.tokenOfVehicle = (id) => { const { manufacturer, serial_number } = system.plant.vehicle(id); return tokens.get(`${manufacturer}/${serial_number}`); };
  system.vehiclesFile = join(system.directory, "vehicles");
  writeFileSync(system.vehiclesFile, `${rows.join("\n")}\n`);
  system.drivers = driving.map((vehicle) => vehicle.id);
  system.driversFile = join(system.directory, "drivers");
  writeFileSync(system.driversFile, driving.map(({ manufacturer, serial_number }) => `${manufacturer}/${serial_number} ${tokens.get(`${manufacturer}/${serial_number}`)}\n`).join(""));
  return system;
}
