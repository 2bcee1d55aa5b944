// The server stands still for a while, as in a migration of its machine or a swap storm: nobody was silent, so nobody is
// lost and no order is interrupted. And a log that nobody reads keeps nobody waiting.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { join } from "node:path";
import { after, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { BUILD, System, freePort, until } from "../harness/processes.mjs";

const VEHICLE = "TP-01";
const systems = [];
after(() => Promise.all(systems.map((system) => system.stop())));

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

test("eleven seconds without the process are no vehicle's silence", async () => {
  const system = await System.create("pulse-line");
  systems.push(system);
  system.prepareVehicles([VEHICLE]);
  await system.startServer();
  const client = new Client(system.url, system.apiToken);
  system.startAgent(VEHICLE, { sensing: "analytic", timeFactor: 2 });
  await client.untilReady(VEHICLE);
  const { needs_resume } = await client.get("/api/v1/fleet");
  if (needs_resume.length > 0) await client.post("/api/v1/fleet/resume", { vehicles: needs_resume });
  const there = (await client.get(`/api/v1/vehicles/${VEHICLE}`)).at_station === system.plant.station(1).id ? 2 : 1;
  const order = await client.order(VEHICLE, [there]);
  await client.untilVehicle(VEHICLE, (v) => v.activity === "moving", "moves");
  const before = (await client.get("/api/v1/fleet")).last_event_seq;

  system.server.kill("SIGSTOP");
  await pause(11_000); // the stall itself
  system.server.kill("SIGCONT");

  assert.equal((await client.untilEnded(order.id, 120)).state, "Ended");
  const events = await client.events(before);
  assert.ok(events.some((event) => event.type === "server.stood_still"), "the stall is told");
  assert.deepEqual(events.filter((event) => event.type === "vehicle.link" && event.params.to === "lost"), []);
  assert.deepEqual(events.filter((event) => event.type === "vehicle.needs_resume"), []);
  assert.deepEqual(events.filter((event) => event.type === "job_order.state" && event.params.to === "Interrupted"), []);
});

test("a log that nobody reads keeps nobody waiting", async () => {
  const system = await System.create("pulse-line");
  systems.push(system);
  const port = await freePort();
  // A shell that never reads stands behind the server's standard error.
  const line = `"$0" serve --db "$1" --listen 127.0.0.1:${port} 2>&1 >/dev/null | sleep 1000`;
  const shell = spawn("bash", ["-c", line, join(BUILD, "pulseline"), system.database], { detached: true, stdio: "ignore" });
  try {
    const url = `http://127.0.0.1:${port}`;
    await until("the server answers", async () => { try { return (await fetch(`${url}/healthz`)).ok; } catch { return false; } }, { timeout_s: 20 });
    // Each leaves a line of some 400 bytes; a pipe holds 64 KB.
    const path = `/api/v1/${"x".repeat(6000)}`;
    for (let i = 0; i < 300; ++i) assert.equal((await fetch(url + path, { signal: AbortSignal.timeout(10_000) })).status, 404);
    assert.ok((await fetch(`${url}/healthz`, { signal: AbortSignal.timeout(10_000) })).ok);
  } finally {
    process.kill(-shell.pid, "SIGKILL");
  }
});
