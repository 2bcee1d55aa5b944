// A disk that fills up under a running server, and gets space again: read-only within a second, told everywhere,
// and over without a restart. On a small tmpfs of a mount namespace of its own; where the machine allows none, the
// server's limit of file size is lowered and raised from outside, which the database meets as a disk fault.
import assert from "node:assert/strict";
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { cpSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { BUILD, System, until } from "../harness/processes.mjs";

const VEHICLE = "TP-01";
let system, client, disk;

/** A mount that only the server sees; reached from outside through its root. */
function smallDisk() {
  const mount = join(system.directory, "disk");
  mkdirSync(mount);
  const probe = spawnSync("unshare", ["-m", "mount", "-t", "tmpfs", "-o", "size=4m", "tmpfs", mount]);
  if (probe.status !== 0) return undefined;
  const script = `mount -t tmpfs -o size=4m tmpfs ${mount} && cp ${system.database} ${mount}/pulseline.db && exec "$@"`;
  const seen = () => join(`/proc/${system.server.pid}/root`, mount);
  return {
    cause: "disk_full",
    start: () => system.start("unshare", ["-m", "sh", "-c", script, "sh", join(BUILD, "pulseline"), "serve", "--db", join(mount, "pulseline.db"), "--listen", `127.0.0.1:${system.port}`], "server"),
    fill: () => { try { writeFileSync(join(seen(), "fill"), Buffer.alloc(8 << 20)); } catch (error) { assert.equal(error.code, "ENOSPC"); } },
    free: () => rmSync(join(seen(), "fill")),
    copyTo: (folder) => { for (const end of ["", "-wal"]) cpSync(join(seen(), `pulseline.db${end}`), join(folder, `p.db${end}`)); },
  };
}

/** The same by RLIMIT_FSIZE, which prlimit changes in a running process. */
function smallLimit() {
  const limit = (bytes) => execFileSync("prlimit", ["--pid", String(system.server.pid), `--fsize=${bytes}:unlimited`]);
  return {
    cause: "disk_error",
    start: () => system.start(join(BUILD, "pulseline"), ["serve", "--db", system.database, "--listen", `127.0.0.1:${system.port}`], "server"),
    fill: () => limit(1),
    free: () => limit("unlimited"),
    copyTo: (folder) => { for (const end of ["", "-wal"]) cpSync(`${system.database}${end}`, join(folder, `p.db${end}`)); },
  };
}

const metric = async (name) => Number(new RegExp(`^${name} (.*)$`, "m").exec((await client.request("GET", "/metrics")).body)[1]);
const order = (number) => client.request("POST", "/api/v1/job-orders", { body: { vehicle: VEHICLE, steps: [{ station: number, motion_mode: "linear" }] } });

/** What a dashboard is told on its stream. */
async function listen() {
  const frames = [];
  const socket = new WebSocket(`${system.url.replace("http", "ws")}/api/v1/stream`, { headers: { Authorization: `Bearer ${system.apiToken}` } });
  socket.onmessage = ({ data }) => { const frame = JSON.parse(data); frames.push(...(frame.type === "changes" ? frame.changes : [frame])); };
  await until("the stream begins", () => frames.some((f) => f.type === "snapshot"), { timeout_s: 10 });
  return { frames, close: () => socket.close() };
}

before(async () => {
  system = await System.create("pulse-line");
  system.prepareVehicles([VEHICLE]);
  client = new Client(system.url, system.apiToken);
});
after(() => system?.stop());

for (const [name, make] of [["a full disk", smallDisk], ["a limit of file size", smallLimit]]) {
  test(`${name}: read-only within a second, and over without a restart`, async (t) => {
    disk = make();
    if (!disk) return t.diagnostic("no mount namespaces here: the limit of file size stands in for the disk");
    system.server = disk.start();
    t.after(() => Promise.all([...system.children].map((child) => system.kill(child))));
    await until(() => `ready:\n${system.log("server")}`, async () => {
      try { return (await fetch(`${system.url}/readyz`)).ok; } catch { return false; }
    }, { timeout_s: 20 });
    const agent = system.startAgent(VEHICLE, { sensing: "analytic", timeFactor: 6 });
    await client.untilReady(VEHICLE);
    const { needs_resume } = await client.get("/api/v1/fleet");
    if (needs_resume.length > 0) await client.post("/api/v1/fleet/resume", { vehicles: needs_resume });
    const stream = await listen();
    const here = (await client.get(`/api/v1/vehicles/${VEHICLE}`)).at_station === system.plant.station(1).id ? 2 : 1;
    const drive = await order(here);
    assert.equal(drive.status, 201, JSON.stringify(drive.body));
    await client.untilVehicle(VEHICLE, (v) => v.activity === "moving", "moves");

    disk.fill();
    const filled = Date.now();
    let refused;
    await until("a command is refused", async () => (refused = await order(here)).status !== 201, { timeout_s: 5, every_ms: 10 });
    await until("it is read-only", async () => (await fetch(`${system.url}/readyz`)).status === 503, { timeout_s: 5, every_ms: 5 });
    assert.ok(Date.now() - filled <= 1000, `read-only after ${Date.now() - filled} ms`);
    assert.equal(refused.status, 503);
    assert.match(JSON.stringify(refused.body), /store_unavailable/);
    const again = await order(here);
    assert.equal(again.status, 503);
    assert.match(JSON.stringify(again.body), disk.cause === "disk_full" ? /free space/ : /disk/);
    assert.match(JSON.stringify((await client.request("GET", "/readyz")).body), /store_unavailable/);
    await until("the dashboard is told", () => stream.frames.some((f) => f.type === "fleet" && f.fleet?.read_only?.cause === disk.cause), { timeout_s: 2, every_ms: 5 });
    assert.equal((await client.get("/api/v1/fleet")).read_only.cause, disk.cause);
    assert.equal(await metric("pulseline_read_only"), 1);
    // Its log is a file as well, which the limit of file size keeps as it is.
    if (disk.cause === "disk_full") assert.match(system.log("server"), /read_only cause=disk_full/);
    // Reads and dashboards go on; no message goes to the vehicle.
    assert.equal((await client.get(`/api/v1/job-orders/${drive.body.id}`)).id, drive.body.id);
    await client.get("/api/v1/vehicles");
    const sent = await metric("pulseline_vehicle_messages_sent_total");
    const told = stream.frames.filter((f) => f.type === "poses").length;
    await until("poses go on", () => stream.frames.filter((f) => f.type === "poses").length >= told + 5, { timeout_s: 10 });
    assert.equal(await metric("pulseline_vehicle_messages_sent_total"), sent, "a vehicle was told something that is not stored");

    // Who wants vehicles to stand is heard at once, and it is stored when there is room.
    assert.equal((await client.request("POST", `/api/v1/vehicles/${VEHICLE}/pause`, { body: {} })).status, 202);
    await until("the vehicle is told", async () => (await metric("pulseline_vehicle_messages_sent_total")) > sent, { timeout_s: 5 });

    const { pid } = system.server;
    disk.free();
    await until("it takes commands again", async () => (await fetch(`${system.url}/readyz`)).ok, { timeout_s: 5, every_ms: 20 });
    assert.equal(system.server.pid, pid);
    assert.equal(await metric("pulseline_read_only"), 0);
    await until("the alarm and its end are events", () => ["store.failed", "store.recovered"].every((type) => stream.frames.some((f) => f.type === "event" && f.event.type === type)), { timeout_s: 5 });
    assert.equal((await client.get("/api/v1/fleet")).read_only, undefined);
    await until("the pause is stored", async () => (await client.events(0)).some((event) => event.type === "vehicle.paused"), { timeout_s: 5 });
    await client.untilVehicle(VEHICLE, (v) => v.paused && v.activity === "paused", "is paused");
    await client.post("/api/v1/fleet/resume", { vehicles: [VEHICLE] });
    // Nothing that was stored is lost, so nobody else is asked: the drive goes on from the last commit.
    assert.equal((await client.untilEnded(drive.body.id, 60)).state, "Ended");
    const events = await client.events(0);
    assert.ok(!events.some((event) => event.type === "vehicle.needs_resume"), "a person was asked");
    events.forEach((event, i) => assert.equal(event.seq, i + 1));
    const copy = join(system.directory, `copy-${disk.cause}`);
    mkdirSync(copy);
    stream.close();
    await system.kill(agent);
    disk.copyTo(copy);
    await system.kill(system.server);
    const { faults } = JSON.parse(execFileSync(join(BUILD, "stored"), ["check", join(copy, "p.db")], { encoding: "utf8" }));
    assert.deepEqual(faults, []);
    const journal = JSON.parse(execFileSync(join(BUILD, "pulseline"), ["journal", "verify", "--db", join(copy, "p.db"), "--json"], { encoding: "utf8" }));
    assert.equal(journal.difference, null);
    assert.ok(journal.inputs > 0);
  });
}
