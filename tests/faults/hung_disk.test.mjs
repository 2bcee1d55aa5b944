// A disk that hangs instead of failing: every fsync of the server is held for as long as a file exists. Nothing stale is
// carried out, nobody waits for ever, vehicles can be stopped, and the server can be ended.
import assert from "node:assert/strict";
import { rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { BUILD, System, until } from "../harness/processes.mjs";

const VEHICLE = "TP-01";
const systems = [];
after(() => Promise.all(systems.map((system) => system.stop())));

async function start() {
  const system = await System.create("pulse-line");
  systems.push(system);
  system.prepareVehicles([VEHICLE]);
  const held = join(system.directory, "held");
  await system.startServer([], { LD_PRELOAD: join(BUILD, "libhold_fsync.so"), PULSELINE_HOLD_FSYNC: held });
  return { system, client: new Client(system.url, system.apiToken), hang: () => writeFileSync(held, ""), goOn: () => rmSync(held, { force: true }) };
}

async function took(promise) {
  const begin = Date.now();
  const answer = await promise;
  return { answer, ms: Date.now() - begin };
}

const ready = async (system) => (await fetch(`${system.url}/readyz`)).status === 200;

test("commands are refused, reads answered, vehicles stopped, and nothing of before is carried out", async () => {
  const { system, client, hang, goOn } = await start();
  system.startAgent(VEHICLE, { sensing: "analytic", timeFactor: 1 });
  await client.untilReady(VEHICLE);
  const { needs_resume } = await client.get("/api/v1/fleet");
  if (needs_resume.length > 0) await client.post("/api/v1/fleet/resume", { vehicles: needs_resume });
  const there = (await client.get(`/api/v1/vehicles/${VEHICLE}`)).at_station === system.plant.station(1).id ? 2 : 1;
  const order = await client.order(VEHICLE, [there]);
  await client.untilVehicle(VEHICLE, (v) => v.activity === "moving", "moves");
  await client.post(`/api/v1/vehicles/${VEHICLE}/pause`, {});
  // It stands, so nothing of its own waits to be stored: what the hang catches is the person's act.
  await client.untilVehicle(VEHICLE, (v) => v.pause_confirmed && v.speed_mps === 0, "stands paused");

  hang();
  const begun = Date.now();
  const caught = client.request("POST", "/api/v1/fleet/resume", { body: { vehicles: [VEHICLE] } });
  await until("it is not ready", async () => !(await ready(system)), { timeout_s: 10, every_ms: 20 });
  assert.ok(Date.now() - begun < 5000, `not ready after ${Date.now() - begun} ms`);
  const refused = await took(client.request("POST", "/api/v1/job-orders", { body: { vehicle: VEHICLE, steps: [{ station: there }] } }));
  assert.equal(refused.answer.status, 503);
  assert.match(JSON.stringify(refused.answer.body), /disk_hangs/);
  assert.ok(refused.ms < 2000, `refused after ${refused.ms} ms`);
  for (const path of ["/api/v1/vehicles", "/api/v1/fleet", "/api/v1/stations", "/healthz"]) {
    const read = await took(client.request("GET", path));
    assert.equal(read.answer.status, 200, path);
    assert.ok(read.ms < 2000, `${path} after ${read.ms} ms`);
  }
  const stopped = await took(client.request("POST", "/api/v1/fleet/pause", { body: {} }));
  assert.equal(stopped.answer.status, 202, JSON.stringify(stopped.answer.body));
  assert.ok(stopped.ms < 2000, `stopped after ${stopped.ms} ms`);
  const unknown = await caught;
  assert.equal(unknown.status, 503);
  assert.match(JSON.stringify(unknown.body), /Idempotency-Key/);
  assert.ok(Date.now() - begun < 12_000, `told after ${Date.now() - begun} ms`);

  const stood = system.lastTruth(VEHICLE);
  goOn();
  await until("it takes commands again", () => ready(system), { timeout_s: 20 });
  const vehicle = await client.untilReady(VEHICLE);
  assert.equal(vehicle.paused, true);
  assert.equal((await client.get("/api/v1/fleet")).read_only, undefined);
  const after = system.lastTruth(VEHICLE);
  assert.ok(Math.hypot(after.x_m - stood.x_m, after.y_m - stood.y_m) < 0.01, "the act of before the hang moved the vehicle");
  // A person's act of now is carried out.
  await client.post("/api/v1/fleet/resume", { vehicles: [VEHICLE] });
  assert.equal((await client.untilEnded(order.id, 120)).state, "Ended");
});

test("it can be ended while its disk hangs, and is watched until then", async () => {
  const { system, client, hang } = await start();
  hang();
  client.request("POST", "/api/v1/fleet/pause", { body: {} }).catch(() => {});
  await until("it is not ready", async () => !(await ready(system)), { timeout_s: 10, every_ms: 20 });
  const begun = Date.now();
  system.server.kill("SIGTERM");
  await new Promise((done) => setTimeout(done, 1000)); // in the middle of its end
  assert.equal((await fetch(`${system.url}/healthz`)).status, 200);
  const end = await system.server.ended;
  assert.deepEqual(end, { code: 1, signal: null });
  assert.ok(Date.now() - begun < 15_000, `ended after ${Date.now() - begun} ms`);
  assert.match(system.log("server"), /stop_unfinished/);
});

test("a second signal ends it at once", async () => {
  const { system, client, hang } = await start();
  hang();
  client.request("POST", "/api/v1/fleet/pause", { body: {} }).catch(() => {});
  await until("it is not ready", async () => !(await ready(system)), { timeout_s: 10, every_ms: 20 });
  system.server.kill("SIGTERM");
  await until("it stops", () => /stopping/.test(system.log("server")), { timeout_s: 10 });
  const begun = Date.now();
  system.server.kill("SIGTERM");
  assert.deepEqual(await system.server.ended, { code: null, signal: "SIGTERM" });
  assert.ok(Date.now() - begun < 2000);
});
