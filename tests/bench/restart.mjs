// ./dev bench restart: how soon a server is ready again with 1,000,000 events and 100,000 finished orders stored, after
// a clean end and after kill -9, and how soon it releases floor to a vehicle once a person allows it.
//   [EVENTS] [ORDERS] [RUNS]
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Client } from "../harness/client.mjs";
import { BUILD, System, until } from "../harness/processes.mjs";

const EVENTS = Number(process.argv[2] ?? 1_000_000), ORDERS = Number(process.argv[3] ?? 100_000), RUNS = Number(process.argv[4] ?? 3);
const LIMIT_READY_MS = 3000, LIMIT_RELEASE_MS = 5000;
const VEHICLE = "TP-01";

const system = await System.create("final-assembly");
system.prepareVehicles([VEHICLE]);
const began = performance.now();
execFileSync(join(BUILD, "stored"), ["fill", system.database, String(EVENTS), String(ORDERS)]);
console.log(`${EVENTS} events and ${ORDERS} finished orders written in ${((performance.now() - began) / 1000).toFixed(1)} s`);
const client = new Client(system.url, system.apiToken);
const agent = system.startAgent(VEHICLE, { sensing: "analytic", timeFactor: 10 });

async function measure(end) {
  const start = performance.now();
  await system.startServer();
  const ready_ms = performance.now() - start;
  await client.untilReady(VEHICLE);
  const needs = (await client.get("/api/v1/fleet")).needs_resume;
  // Connected is not yet reported: until its first state the vehicle counts as silent.
  const allow = async () => (await client.request("POST", "/api/v1/fleet/resume", { body: { vehicles: needs } })).status < 300;
  if (needs.length > 0) await until("the vehicle may move", allow, { timeout_s: 10, every_ms: 5 });
  const rss_mb = Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${system.server.pid}/status`, "utf8"))[1]) / 1024;
  const at = (await client.get(`/api/v1/vehicles/${VEHICLE}`)).at_station;
  const target = system.plant.station(1).id === at ? 2 : 1;
  await client.order(VEHICLE, [target]);
  await client.untilVehicle(VEHICLE, (v) => v.activity === "moving" || v.activity === "measuring", "moves");
  const release_ms = performance.now() - start;
  if (end === "kill") await system.kill(system.server);
  else { system.server.kill("SIGTERM"); await system.server.ended; }
  return { after: end, ready_ms: Math.round(ready_ms), first_release_ms: Math.round(release_ms), rss_mb: +rss_mb.toFixed(1) };
}

const results = [];
let after = "fill";
for (let i = 0; i < RUNS; ++i) {
  const end = i % 2 === 0 ? "kill" : "stop";
  results.push({ ...(await measure(end)), after });
  after = end;
  console.log(JSON.stringify(results.at(-1)));
}
await system.kill(agent);
await system.stop();
mkdirSync(join(BUILD, "bench"), { recursive: true });
writeFileSync(join(BUILD, "bench/restart.json"), JSON.stringify({ date: new Date().toISOString(), events: EVENTS, orders: ORDERS, limit_ready_ms: LIMIT_READY_MS, limit_first_release_ms: LIMIT_RELEASE_MS, results }, null, 2));
const worst = Math.max(...results.map((r) => r.ready_ms)), release = Math.max(...results.map((r) => r.first_release_ms));
console.log(`ready in ${worst} ms at worst (limit ${LIMIT_READY_MS}), first release after ${release} ms (limit ${LIMIT_RELEASE_MS})`);
process.exitCode = worst <= LIMIT_READY_MS && release <= LIMIT_RELEASE_MS ? 0 : 1;
