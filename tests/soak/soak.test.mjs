// A server that runs for long: vehicles that report, dashboards, programs that ask, and orders that are driven, with restarts
// in between. What grows must be what people asked to be kept.
//   PULSELINE_SOAK  hours (the nightly: 2); without it a smoke of a minute and a half, which holds absolute bounds only
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdirSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { Client } from "../harness/client.mjs";
import { BUILD, until } from "../harness/processes.mjs";
import { descriptors, hall, rss_kb } from "../load/hall.mjs";
import { modelOf, slope } from "./growth.mjs";

const hours = Number(process.env.PULSELINE_SOAK ?? 0);
const kFull = hours > 0;
const kLives = kFull ? Math.max(1, Math.round(1.5 * hours)) : 2;
const kLife_s = kFull ? (3600 * hours) / kLives : 30;
// A third of what tests/load holds a server to.
const kLoad = { vehicles: 300, dashboards: 60, requests: 60 };
const kDrivers = 6;
// The fleet keeps the names of ended orders for a week: a plant's rate of them, 180 an hour, not a benchmark's.
const kOrderEvery_s = kFull ? 120 : 5;
const kSampleEvery_ms = kFull ? 5000 : 1000;
const kWarm_s = kFull ? Math.min(600, kLife_s / 2) : kLife_s / 3; // queues, caches and the heap's reserves find their size
// What is kept up to a number has it before anything is measured: the newest 4,096 events and 1,000 ended orders.
const kKept = { events: kFull ? 4096 : 200, at_once: 4 };
// Free pages of the file: a journal of 10,000 inputs and a snapshot leave as many, which the next ones take again (5.3 MB
// measured). By no more may the file grow while it is measured.
const kBounds = { slope_mb_per_h: 1, error_mb_per_h: 2, rss_kb: 256 * 1024, grown_kb: 24 * 1024, wal_bytes: 32 * 1024 * 1024, free_bytes: 8 * 1024 * 1024, model: kFull ? 0.2 : 0.3 };

const pause = (ms) => new Promise((done) => setTimeout(done, ms));
const sizeOf = (file) => statSync(file, { throwIfNoEntry: false })?.size ?? 0;
const sizes = (system) => JSON.parse(execFileSync(join(BUILD, "stored"), ["sizes", system.database], { encoding: "utf8" }));

/** One order after the other for a vehicle of its own; each is waited for. How many ended. */
async function drive(client, vehicle, [one, other], life) {
  let ended = 0;
  for (let n = 0; life.on; ++n) {
    const begin = Date.now();
    const order = await client.order(vehicle, [n % 2 === 0 ? other : one], { "Idempotency-Key": `${life.name}-${vehicle}-${n}` });
    assert.equal((await client.untilEnded(order.id, 120)).state, "Ended");
    ++ended;
    while (life.on && Date.now() - begin < 1000 * kOrderEvery_s) await pause(100); // the rate of orders
  }
  return ended;
}

/** Orders that are given and cancelled, until so many events were written. */
async function fill(client, vehicle, station, life, before) {
  const one = async (lane) => {
    for (let n = 0; (await client.get("/api/v1/fleet")).last_event_seq - before < kKept.events; ++n) {
      const order = await client.post("/api/v1/job-orders", { vehicle, steps: [{ station }], start: false }, { "Idempotency-Key": `${life.name}-fill-${lane}-${n}` });
      await client.post(`/api/v1/job-orders/${order.id}/cancel`, {});
    }
  };
  await Promise.all(Array.from({ length: kKept.at_once }, (_, lane) => one(lane)));
}

/** Vehicles, dashboards and programs beside the agent's vehicles; resolves to the load client's figures. */
function load(system) {
  const args = ["--port", system.port, "--vehicles", system.vehiclesFile, "--token", system.apiToken, "--dashboard-tokens", system.dashboardTokens.join(","), "--dashboards", kLoad.dashboards, "--requests", kLoad.requests, "--orders", 0, "--seconds", kLife_s];
  const child = spawn(join(BUILD, "load_client"), args.map(String), { stdio: ["ignore", "pipe", "inherit"] });
  system.children.add(child);
  let text = "";
  child.stdout.on("data", (data) => { text += data; });
  child.ended = new Promise((done) => child.on("exit", () => { system.children.delete(child); done(); }));
  return child.ended.then(() => JSON.parse(text));
}

async function sample(system, client, began) {
  const metrics = (await client.request("GET", "/metrics")).body;
  const figure = (name) => Number(new RegExp(`^${name} (\\S+)$`, "m").exec(metrics)[1]);
  return { hours: (Date.now() - began) / 3.6e6, rss_kb: rss_kb(system.server.pid), heap: figure("pulseline_heap_bytes"), fds: descriptors(system.server.pid), db: sizeOf(system.database), wal: sizeOf(`${system.database}-wal`), commits: figure("pulseline_commits_total"), events: figure("pulseline_event_seq") };
}

/** From the server's start to its orderly end. */
async function live(system, client, number) {
  await system.startServer();
  await Promise.all(system.drivers.map((id) => client.untilReady(id)));
  const { needs_resume } = await client.get("/api/v1/fleet");
  const waiting = needs_resume.filter((id) => system.drivers.includes(id));
  if (waiting.length > 0) await client.post("/api/v1/fleet/resume", { vehicles: waiting });
  // A connection of this test itself may be open or not.
  const settled = async (most) => { const count = descriptors(system.server.pid); return count <= most && count; };
  const fds_before = descriptors(system.server.pid);
  const { last_event_seq } = await client.get("/api/v1/fleet");

  const life = { on: true, name: `life${number}` };
  const stations = (id) => { const n = Number(id.slice(1)); return [2 * n - 1, 2 * n]; };
  await fill(client, system.drivers[0], stations(system.drivers[0])[0], life, last_event_seq);
  const began = Date.now(), samples = [];
  const driving = Promise.all(system.drivers.map((id) => drive(client, id, stations(id), life)));
  driving.catch(() => {}); // told below
  const loaded = load(system);
  let over = false;
  loaded.finally(() => { over = true; });
  while (!over) {
    samples.push(await sample(system, client, began));
    await Promise.race([loaded, pause(kSampleEvery_ms)]);
  }
  const figures = await loaded;
  life.on = false;
  const orders = (await driving).reduce((sum, n) => sum + n, 0);
  // On a machine that others use it stands still now and then; what waited meanwhile was held, and the heap keeps its size.
  const stalls = (await client.events(last_event_seq)).filter((event) => event.type === "server.stood_still").map((event) => (Date.parse(event.at) - event.params.for_s * 1000 - began) / 3.6e6);
  const fds_after = await until(() => `descriptors back at ${fds_before}; now ${descriptors(system.server.pid)}`, () => settled(fds_before + 1), { timeout_s: 30, every_ms: 100 });
  system.server.kill("SIGTERM");
  assert.deepEqual(await system.server.ended, { code: 0, signal: null });

  const warm = samples.filter((s) => 3600 * s.hours >= kWarm_s);
  const { value, error } = slope(warm.map((s) => ({ x: s.hours, y: s.rss_kb / 1024 })), stalls);
  const heap = slope(warm.map((s) => ({ x: s.hours, y: s.heap / 2 ** 20 })), stalls);
  return { samples, figures, orders, fds_before, fds_after, stalls, warm, slope_mb_per_h: value, error_mb_per_h: error, heap, last: samples.at(-1) };
}

const mb = (bytes) => (bytes / 2 ** 20).toFixed(1);

test(`${kLives} lives of ${Math.round(kLife_s)} s: memory, descriptors and the database do not grow by more than what is kept`, { timeout: (kLives * (kLife_s + 300) + 60) * 1000 }, async (t) => {
  const system = await hall(kLoad.vehicles + kDrivers, kDrivers);
  t.after(() => system.stop());
  const client = new Client(system.url, system.apiToken);
  system.start(join(BUILD, "pulseline-agent"), ["--server", `ws://127.0.0.1:${system.port}`, "--vehicles", system.driversFile, "--world", system.plant.file, "--seed", "1", "--time-factor", "20", "--sensing", "analytic"], "agents");
  const fresh = sizes(system);
  const lives = [];
  for (let number = 1; number <= kLives; ++number) {
    const life = await live(system, client, number);
    const stored = sizes(system);
    Object.assign(life, { stored, used: stored.bytes - stored.free_bytes, model: modelOf(fresh, stored) });
    lives.push(life);
    const { last, warm } = life;
    t.diagnostic([`life ${number}: ${(60 * last.hours).toFixed(1)} min, ${life.orders} orders, ${last.commits} commits, ${last.events} events`,
      `RSS ${mb(1024 * warm[0].rss_kb)} to ${mb(1024 * last.rss_kb)} MB, slope ${life.slope_mb_per_h.toFixed(2)} +- ${life.error_mb_per_h.toFixed(2)} MB/h, ${life.stalls.length} standstills`,
      `heap ${mb(warm[0].heap)} to ${mb(last.heap)} MB, slope ${life.heap.value.toFixed(2)} +- ${life.heap.error.toFixed(2)} MB/h`,
      `descriptors ${life.fds_before} -> ${last.fds} -> ${life.fds_after}`,
      `database ${mb(life.used)} MB, model ${mb(life.model)} MB (${(100 * (life.used / life.model - 1)).toFixed(0)} %), ${mb(stored.free_bytes)} MB free, WAL at most ${mb(Math.max(...life.samples.map((s) => s.wal)))} MB`].join("; "));
  }
  mkdirSync(join(BUILD, "bench"), { recursive: true });
  writeFileSync(join(BUILD, "bench/soak.json"), JSON.stringify({ hours, fresh, lives }, null, 1));

  for (const [i, life] of lives.entries()) {
    const which = `life ${i + 1}`, { warm, stored, used, model, figures } = life;
    assert.equal(figures.vehicles_lost + figures.vehicles_cut + figures.dashboards_cut, 0, `${which}: ${JSON.stringify(figures)}`);
    assert.ok(life.orders >= kDrivers * Math.floor(kLife_s / kOrderEvery_s / 2), `${which}: ${life.orders} orders`);
    const highest = Math.max(...life.samples.map((s) => s.rss_kb));
    assert.ok(highest <= kBounds.rss_kb, `${which}: RSS ${highest} KB`);
    if (kFull) {
      // Of two standard errors: what is no growth is told from one in nearly all runs.
      assert.ok(life.error_mb_per_h <= kBounds.error_mb_per_h, `${which}: +- ${life.error_mb_per_h.toFixed(2)} MB/h tells nothing`);
      assert.ok(life.slope_mb_per_h - 2 * life.error_mb_per_h <= kBounds.slope_mb_per_h, `${which}: RSS grows by ${life.slope_mb_per_h.toFixed(2)} +- ${life.error_mb_per_h.toFixed(2)} MB/h`);
    } else {
      assert.ok(life.last.rss_kb - warm[0].rss_kb <= kBounds.grown_kb, `${which}: RSS ${warm[0].rss_kb} to ${life.last.rss_kb} KB`);
    }
    assert.ok(Math.max(...life.samples.map((s) => s.wal)) <= kBounds.wal_bytes, `${which}: WAL`);
    assert.ok(stored.free_bytes <= kBounds.free_bytes, `${which}: ${stored.free_bytes} bytes of the database are free`);
    assert.ok(life.last.db - warm[0].db <= kBounds.free_bytes, `${which}: the database's file grew from ${warm[0].db} to ${life.last.db} bytes`);
    assert.ok(Math.abs(used / model - 1) <= kBounds.model, `${which}: database ${used} bytes in use, model ${Math.round(model)}: ${JSON.stringify(stored)}`);
  }
});
