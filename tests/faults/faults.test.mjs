// Things that go wrong around the server: each ends in a clear message, nothing half done.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { BUILD, System, freePort, until } from "../harness/processes.mjs";

const SERVER = join(BUILD, "pulseline");
let system, client;
before(async () => {
  system = await System.create("pulse-line");
  system.prepareVehicles(["TP-01"]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
});
after(() => system?.stop());

const run = (args, options = {}) => spawnSync(SERVER, args, { encoding: "utf8", timeout: 20_000, ...options });
const said = (result) => result.stdout + result.stderr;

test("a port in use ends the start with the address and a remedy", () => {
  const result = run(["serve", "--db", join(system.directory, "other.db"), "--plant", system.plant.file, "--listen", `127.0.0.1:${system.port}`]);
  assert.equal(result.status, 2, said(result));
  assert.match(said(result), new RegExp(`127\\.0\\.0\\.1:${system.port}`));
});

test("a second server on the same database is refused", async () => {
  const result = run(["serve", "--db", system.database, "--listen", `127.0.0.1:${await freePort()}`]);
  assert.notEqual(result.status, 0);
  assert.match(said(result), /pulseline\.db/);
});

test("a writing subcommand refuses while the server holds the database", () => {
  const result = run(["user", "add", "eve", "--role", "viewer", "--password-stdin", "--db", system.database], { input: "a-long-password" });
  assert.notEqual(result.status, 0);
  assert.match(said(result), /server/i);
});

test("another address without TLS is refused", async () => {
  const result = run(["serve", "--db", join(system.directory, "lan.db"), "--plant", system.plant.file, "--listen", `0.0.0.0:${await freePort()}`]);
  assert.notEqual(result.status, 0);
  assert.match(said(result), /tls/i);
});

test("a corrupt plant file is named and nothing is stored", () => {
  const file = join(system.directory, "broken.json");
  const plant = JSON.parse(readFileSync(system.plant.file, "utf8"));
  plant.stations[2].markers[0] = "nowhere";
  delete plant.vehicles[0].type;
  writeFileSync(file, JSON.stringify(plant));
  const validated = run(["plant", "validate", file]);
  assert.notEqual(validated.status, 0);
  assert.match(said(validated), /\/vehicles\/0\/type|\/stations\/2\/markers\/0/);
  writeFileSync(file, '{"id": "x", ');
  const database = join(system.directory, "never.db");
  const imported = run(["plant", "import", file, "--db", database]);
  assert.notEqual(imported.status, 0);
  assert.match(said(imported), /broken\.json/);
});

test("a full disk at the start is named", { skip: process.getuid() !== 0 && "needs root to mount a small file system" }, (t) => {
  const mount = join(system.directory, "tiny");
  mkdirSync(mount);
  try {
    execFileSync("mount", ["-t", "tmpfs", "-o", "size=64k", "tmpfs", mount]);
  } catch {
    return t.skip("this machine allows no mounts");
  }
  try {
    spawnSync("dd", ["if=/dev/zero", `of=${mount}/fill`, "bs=1k"], { stdio: "ignore" });
    const result = run(["serve", "--db", join(mount, "p.db"), "--plant", system.plant.file, "--listen", "127.0.0.1:0"]);
    assert.notEqual(result.status, 0);
    assert.match(said(result), /tiny/);
  } finally {
    execFileSync("umount", [mount]);
  }
});

test("a low limit of open files is raised at the start", async (t) => {
  const port = await freePort();
  const args = ["serve", "--db", join(system.directory, "files.db"), "--plant", system.plant.file, "--listen", `127.0.0.1:${port}`];
  const server = system.start("prlimit", ["--nofile=100:1000", SERVER, ...args], "files");
  t.after(() => system.kill(server));
  await until(() => `it answers; its log:\n${system.log("files")}`, async () => {
    try { return (await fetch(`http://127.0.0.1:${port}/readyz`)).ok; } catch { return false; }
  }, { timeout_s: 20 });
  assert.match(readFileSync(`/proc/${server.pid}/limits`, "utf8"), /^Max open files +1000 +1000 /m);
  assert.match(system.log("files"), /few_descriptors allowed=1000/);
});

test("a wrong or missing vehicle token is refused and the agent says so", async () => {
  const { manufacturer, serial_number } = system.plant.vehicle("TP-01");
  const agent = system.start(join(BUILD, "pulseline-agent"), ["--server", `ws://127.0.0.1:${system.port}`, "--vehicle", `${manufacturer}/${serial_number}`, "--token", "plv_wrong", "--world", system.plant.file, "--sensing", "analytic"], "agent-wrong");
  await until("the refusal is in the agent's log", () => /40[13]/.test(system.log("agent-wrong")), { timeout_s: 10 });
  await system.kill(agent);
});

test("a second vehicle with the same identity replaces the first, which does not come back", async () => {
  const first = system.startAgent("TP-01", { sensing: "analytic" });
  await client.untilReady("TP-01");
  system.startAgent("TP-01", { sensing: "analytic", seed: 2 });
  const over = await first.ended;
  assert.equal(over.code, 3, "the replaced one ends by itself");
  await client.untilVehicle("TP-01", (v) => v.link === "live", "is live with the second");
});

test("a malformed VDA 5050 message is counted and told, the link stays", async () => {
  const agents = [...system.agents.values()];
  for (const agent of agents) if (!agent.over) await system.kill(agent);
  const { manufacturer, serial_number } = system.plant.vehicle("TP-01");
  const socket = new WebSocket(`ws://127.0.0.1:${system.port}/vehicles/${manufacturer}/${serial_number}`, { protocols: ["vda5050.v2.json"], headers: { Authorization: `Bearer ${system.tokenOf("TP-01")}` } });
  await new Promise((done, failed) => { socket.onopen = done; socket.onerror = () => failed(new Error("no link")); });
  const { last_event_seq } = await client.get("/api/v1/fleet");
  for (const text of ["nonsense", '{"topic":"state","retain":false,"payload":{"headerId":"x"}}', '{"topic":"coffee","payload":{}}', "[".repeat(60_000)]) socket.send(text);
  await until("the message is told as an event", async () => (await client.events(last_event_seq)).some((e) => /malformed/.test(e.type)), { timeout_s: 10, every_ms: 100 });
  assert.equal(socket.readyState, 1, "the link stays");
  socket.close();
});

test("the server ends cleanly on SIGTERM and starts again in time", async () => {
  system.server.kill("SIGTERM");
  assert.deepEqual(await system.server.ended, { code: 0, signal: null });
  await system.startServer();
  assert.equal((await client.request("GET", "/readyz")).status, 200);
});
