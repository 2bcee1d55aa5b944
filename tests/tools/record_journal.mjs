// Records the database of a minute in which much happens: node tests/tools/record_journal.mjs OUT.db.gz. Twelve simulated vehicles get
// orders by chance; vehicles and orders are paused, cancelled and resumed, floor is closed, and an agent is started anew. What the
// recording program stored, a later one has to replay: tests/kills/recorded.test.mjs.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { Client } from "../harness/client.mjs";
import { BUILD, System } from "../harness/processes.mjs";

const system = await System.create("final-assembly");
const { vehicles, stations, halls } = system.plant.model;
const ids = vehicles.map((v) => v.id);
system.prepareVehicles(ids);
await system.startServer();
const client = new Client(system.url, system.apiToken);
const start = (id) => system.startAgent(id, { seed: ids.indexOf(id) + 1, sensing: "analytic", timeFactor: 20 });
ids.forEach(start);
await Promise.all(ids.map((id) => client.untilReady(id)));

let seed = 12345;
const random = (n) => { seed = (seed * 1103515245 + 12345) & 0x7fffffff; return (seed >> 9) % n; };
const one = (list) => list[random(list.length)];
const pass = (ms) => new Promise((done) => setTimeout(done, ms));
const send = (method, path, body) => fetch(system.url + path, {
  method, headers: { authorization: `Bearer ${system.apiToken}`, "content-type": "application/json" }, body: body && JSON.stringify(body),
}).then((answer) => answer.json().catch(() => ({})), () => ({}));

const acts = {
  async order() {
    const vehicle = one(ids), { type } = system.plant.vehicle(vehicle);
    const steps = Array.from({ length: 1 + random(2) }, () => ({ station: one(stations.filter((s) => s.vehicle_types.includes(type))).number }));
    await send("POST", "/api/v1/job-orders", random(3) ? { vehicle, steps } : { vehicle_type: type, steps: steps.slice(0, 1) });
  },
  async pause() {
    const vehicle = one(ids);
    await send("POST", `/api/v1/vehicles/${vehicle}/pause`);
    await pass(700);
    await send("POST", "/api/v1/fleet/resume", { vehicles: [vehicle] });
  },
  async control() {
    const { items } = await client.get("/api/v1/job-orders?state=Running");
    if (items.length > 0) await send("POST", `/api/v1/job-orders/${one(items).id}/job-control`, { method: one(["Cancel", "Stop", "Abort", "Pause", "Resume"]) });
  },
  async close() {
    const outline = [[60, 20], [64, 20], [64, 24], [60, 24]].map(([x_m, y_m]) => ({ x_m, y_m }));
    const { id } = await send("POST", "/api/v1/closures", { name: "work", hall: halls[0].id, outline });
    await pass(1500);
    if (id) await send("DELETE", `/api/v1/closures/${id}`);
  },
  async restart() {
    const id = one(ids);
    await system.kill(system.agents.get(id));
    start(id);
  },
  resume: () => send("POST", "/api/v1/fleet/resume", { vehicles: ids }),
};
const often = ["order", "order", "order", "order", "order", "order", "pause", "control", "resume", "close"];
const end = Date.now() + 60_000;
for (let n = 1; Date.now() < end; ++n) {
  await acts[n % 60 === 0 ? "restart" : one(often)]();
  await pass(400);
}
await system.stop();
console.log(execFileSync(join(BUILD, "pulseline"), ["journal", "verify", "--db", system.database], { encoding: "utf8" }));
writeFileSync(process.argv[2], gzipSync(readFileSync(system.database), { level: 9 }));
