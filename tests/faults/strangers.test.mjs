// Many connections that do nothing, read nothing or say everything slowly, against the real server on the loopback.
// The quick form takes a minute; PULSELINE_STRANGERS=10 makes ten times as many of each, as every night.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { connect as connectTls } from "node:tls";
import { join } from "node:path";
import { after, afterEach, before, test } from "node:test";
import { System, until } from "../harness/processes.mjs";

const SCALE = Number(process.env.PULSELINE_STRANGERS ?? 1);
let system;
const config = () => join(system.directory, "server.toml");
const sockets = new Set();

function open(bytes, { reads = true, to = system } = {}) {
  return new Promise((done, failed) => {
    const how = { port: to.port, host: to.host, rejectUnauthorized: false };
    const socket = (to.scheme === "https" ? connectTls : connect)(how, () => { socket.opened_ms = performance.now(); socket.write(bytes); done(socket); });
    sockets.add(socket);
    socket.on("error", failed);
    socket.on("close", () => { sockets.delete(socket); socket.isOver = true; socket.life_s = (performance.now() - socket.opened_ms) / 1000; });
    if (reads) socket.resume(); else socket.pause();
  });
}
/** Some at a time: the queue of connections not yet accepted is short. */
async function openMany(count, make) {
  const made = [];
  for (let from = 0; from < count; from += 100) {
    made.push(...await Promise.all(Array.from({ length: Math.min(100, count - from) }, (_, i) => make(from + i))));
  }
  return made;
}
function closeAll() {
  for (const socket of sockets) socket.destroy();
}

const bearer = (to) => `Authorization: Bearer ${to.apiToken}\r\n`;
const upgrade = (to = system) => `GET /api/v1/stream HTTP/1.1\r\nHost: x\r\n${bearer(to)}Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n`;
const get = (path, of = system) => fetch(of.url + path, { headers: { Authorization: `Bearer ${of.apiToken}`, Connection: "close" } });
const metric = async (name, of = system) => Number(new RegExp(`^${name} (.*)$`, "m").exec(await (await get("/metrics", of)).text())[1]);
const residentMB = (of = system) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${of.server.pid}/status`, "utf8"))[1]) / 1024;

/** Reads WebSocket frames out of chunks: answers pings, and hands on whole messages. */
function readFrames(socket, message) {
  let rest = Buffer.alloc(0);
  let parts = [];
  return (chunk) => {
    rest = Buffer.concat([rest, chunk]);
    for (;;) {
      if (rest.length < 2) return;
      let length = rest[1] & 127, head = 2;
      if (length === 126) head = 4;
      if (length === 127) head = 10;
      if (rest.length < head) return;
      if (length === 126) length = rest.readUInt16BE(2);
      if (length === 127) length = Number(rest.readBigUInt64BE(2));
      if (rest.length < head + length) return;
      const opcode = rest[0] & 15, isLast = (rest[0] & 128) !== 0, payload = rest.subarray(head, head + length);
      if (opcode === 9) socket.write(Buffer.concat([Buffer.from([0x8a, 0x80 | length, 0, 0, 0, 0]), payload]));
      if (opcode < 3) parts.push(payload);
      if (opcode < 3 && isLast) { message(JSON.parse(Buffer.concat(parts).toString("utf8"))); parts = []; }
      rest = rest.subarray(head + length);
    }
  };
}
/** Past the answer to the upgrade. */
function readStream(socket, message) {
  let head = "";
  const frames = readFrames(socket, message);
  return (chunk) => {
    if (head === undefined) return frames(chunk);
    head += chunk.toString("latin1");
    const end = head.indexOf("\r\n\r\n");
    if (end < 0) return;
    const first = Buffer.from(head.slice(end + 4), "latin1");
    assert.match(head, /^HTTP\/1.1 101 /);
    head = undefined;
    frames(first);
  };
}

/** How long /healthz takes, asked every 50 ms until stopped; the slowest but one of a hundred. */
function watchHealth() {
  const took = [];
  let over = false;
  const loop = (async () => {
    while (!over) {
      const begin = performance.now();
      assert.equal((await get("/healthz")).status, 200);
      took.push(performance.now() - begin);
      await new Promise((done) => setTimeout(done, 50));
    }
  })();
  return async () => {
    over = true;
    await loop;
    took.sort((a, b) => a - b);
    return { p50: took[Math.floor(took.length / 2)], p99: took[Math.floor(took.length * 0.99)] };
  };
}

before(async () => {
  system = await System.create("pulse-line");
  system.prepareVehicles([system.plant.model.vehicles[0].id]);
  writeFileSync(config(), "[limits]\nstreams_per_user = 20000\n");
  await system.startServer(["--config", config()]);
});
afterEach(closeAll);
after(() => system.stop());

test("idle WebSockets take little memory, and those that never read are cut", { timeout: 120_000 * SCALE }, async () => {
  const count = 1000 * SCALE;
  await get("/readyz");
  const before = residentMB();

  const began = performance.now();
  await openMany(count, () => open(upgrade(), { reads: false }));
  const opened_s = (performance.now() - began) / 1000;
  await until("all are streams", async () => await metric("pulseline_stream_clients") >= count, { timeout_s: 20 * SCALE });
  const each_kB = (residentMB() - before) * 1024 / count;
  const good = await openMany(10, () => open(upgrade()));
  for (const socket of good) socket.on("data", readStream(socket, () => {}));
  const health = watchHealth();
  // Nobody answers the server's pings but the good ones.
  await until("those that never read are gone", async () => await metric("pulseline_stream_clients") <= good.length, { timeout_s: 30 });
  const { p50, p99 } = await health();

  console.log(`${count} WebSockets in ${opened_s.toFixed(1)} s, ${each_kB.toFixed(0)} KB each; /healthz p50 ${p50.toFixed(0)} ms, p99 ${p99.toFixed(0)} ms`);
  // A sanitizer's own memory is not the server's.
  if (!process.env.PULSELINE_SANITIZED) assert.ok(each_kB <= 15, `${each_kB} KB each`);
  assert.equal(good.filter((socket) => socket.isOver).length, 0, "those that read stay");
});

test("after a restart of the server everybody comes back", { timeout: 120_000 * SCALE }, async () => {
  const count = 1000 * SCALE;
  await until("the connections of before are gone", async () => await metric("pulseline_connections") <= 2);
  const everybody = () => openMany(count, async () => { const socket = await open(upgrade()); socket.on("data", readStream(socket, () => {})); });
  await everybody();
  await until("all are streams", async () => await metric("pulseline_stream_clients") >= count, { timeout_s: 20 * SCALE });

  system.server.kill("SIGTERM");
  await system.server.ended;
  await until("all have seen its end", () => sockets.size === 0);
  const began = performance.now();
  await system.startServer(["--config", config()]);
  await everybody();
  await until("all are back", async () => await metric("pulseline_stream_clients") >= count, { timeout_s: 30 });
  const back_s = (performance.now() - began) / 1000;

  console.log(`${count} WebSockets back ${back_s.toFixed(1)} s after the server's start began`);
  assert.equal(sockets.size, count, "nobody was turned away");
  assert.ok(back_s <= 30, `${back_s} s`);
});

test("idle WebSockets over TLS take little memory, too", { timeout: 120_000 * SCALE }, async () => {
  const count = 500 * SCALE;
  process.env.NODE_TLS_REJECT_UNAUTHORIZED = "0";  // the server signs for itself
  const secure = await System.create("pulse-line");
  try {
    secure.scheme = "https";
    await secure.startServer(["--config", config(), "--tls-self-signed"]);
    await get("/readyz", secure);
    const before = residentMB(secure);
    await openMany(count, async () => { const socket = await open(upgrade(secure), { to: secure }); socket.on("data", readStream(socket, () => {})); });
    await until("all are streams", async () => await metric("pulseline_stream_clients", secure) >= count, { timeout_s: 20 * SCALE });
    const each_kB = (residentMB(secure) - before) * 1024 / count;

    console.log(`${count} WebSockets over TLS, ${each_kB.toFixed(0)} KB each`);
    // Asio keeps four buffers of 17 KB for a TLS connection, whatever passes through it; ours is the rest.
    if (!process.env.PULSELINE_SANITIZED) assert.ok(each_kB <= 90, `${each_kB} KB each`);
  } finally {
    closeAll();
    await secure.stop();
    delete process.env.NODE_TLS_REJECT_UNAUTHORIZED;
  }
});

test("a dashboard that reads 1 KB a second keeps its stream and is shown what is new", { timeout: 120_000 }, async () => {
  const { id, manufacturer, serial_number, home } = system.plant.model.vehicles[0];
  const station = system.plant.model.stations.find((one) => one.id === home);
  const vehicle = new WebSocket(`ws://127.0.0.1:${system.port}/vehicles/${manufacturer}/${serial_number}`, { protocols: ["vda5050.v2.json"], headers: { Authorization: `Bearer ${system.tokenOf(id)}` } });
  await new Promise((done, failed) => { vehicle.onopen = done; vehicle.onerror = failed; });
  let n = 0;
  const talk = setInterval(() => {
    const header = { headerId: ++n, timestamp: new Date().toISOString(), version: "2.1.0", manufacturer, serialNumber: serial_number };
    const agvPosition = { x: station.pose.x_m + (n % 10) * 1e-4, y: station.pose.y_m, theta: station.pose.heading_rad, mapId: station.hall, positionInitialized: true };
    const state = { ...header, orderId: "", orderUpdateId: 0, lastNodeId: station.node, lastNodeSequenceId: 0, driving: false, operatingMode: "AUTOMATIC", nodeStates: [], edgeStates: [], actionStates: [],
      batteryState: { batteryCharge: 50 + (n % 40), charging: false }, safetyState: { eStop: "NONE", fieldViolation: false }, errors: [], agvPosition };
    vehicle.send(JSON.stringify({ topic: "state", retain: false, payload: state }));
  }, 100);

  const bytes = Buffer.alloc(102);
  const shown = [];
  const reader = connect({ port: system.port, host: "127.0.0.1", onread: { buffer: bytes, callback: (read) => { take(Buffer.from(bytes.subarray(0, read))); return false; } } });
  const take = readStream(reader, (message) => {
    for (const change of message.type === "changes" ? message.changes : [message]) if (change.type === "poses") shown.push({ at: performance.now(), age_s: (Date.now() - Date.parse(change.at)) / 1000 });
  });
  reader.on("close", () => { reader.isOver = true; });
  reader.on("error", () => {});
  reader.write(upgrade());
  const began = performance.now();
  const sip = setInterval(() => reader.resume(), 100);
  try {
    await until("it has read for 45 s", () => reader.isOver || performance.now() - began > 45_000, { timeout_s: 60, every_ms: 200 });
    const late = shown.filter(({ at }) => at - began > 20_000).map(({ age_s }) => age_s);
    console.log(`${shown.length} poses read at 1 KB/s, ${Math.max(...late).toFixed(1)} s old at most`);
    assert.ok(!reader.isOver, "it was cut");
    assert.ok(late.length > 0 && Math.max(...late) < 15, `poses ${late.map((age) => age.toFixed(1))} s old`);
  } finally {
    clearInterval(talk);
    clearInterval(sip);
    vehicle.close();
    reader.destroy();
  }
});

test("whoever sends or reads slowly is cut within 15 s, and nobody else notices", { timeout: 120_000 * SCALE }, async () => {
  const count = 130 * SCALE;
  await until("the connections of before are gone", async () => await metric("pulseline_connections") <= 2);
  const quiet = watchHealth();
  await new Promise((done) => setTimeout(done, 3000));
  const before = await quiet();

  const heads = await openMany(count, () => open("GET /healthz HTTP/1.1\r\nHost: x\r\nX-Slow: "));
  const bodies = await openMany(count, () => open("POST /api/v1/session HTTP/1.1\r\nHost: x\r\nContent-Length: 4000\r\n\r\n"));
  await openMany(count, () => open("GET /api/v1/openapi.json HTTP/1.1\r\nHost: x\r\n\r\n".repeat(40), { reads: false }));
  const trickle = setInterval(() => { for (const socket of [...heads, ...bodies]) if (!socket.isOver) socket.write("x", () => {}); }, 500);
  for (const socket of sockets) { socket.removeAllListeners("error"); socket.on("error", () => {}); }
  const began = performance.now();
  const health = watchHealth();
  await until("all are cut", async () => await metric("pulseline_connections") <= 2, { timeout_s: 40, every_ms: 200 });
  const cut_s = (performance.now() - began) / 1000;
  clearInterval(trickle);
  const { p50, p99 } = await health();

  // One that never reads does not see its own end.
  const longest_s = Math.max(...[...heads, ...bodies].map((socket) => socket.life_s ?? Infinity));
  console.log(`${3 * count} slow ones cut in ${cut_s.toFixed(1)} s, none of those that send after more than ${longest_s.toFixed(1)} s of its own; /healthz p50 ${p50.toFixed(1)} ms (${before.p50.toFixed(1)} before), p99 ${p99.toFixed(0)} ms (${before.p99.toFixed(0)})`);
  assert.ok(longest_s <= 15, `${longest_s} s`);
  assert.ok(cut_s <= 15, `${cut_s} s after the last was opened`);
  assert.ok(p99 < Math.max(100, 4 * before.p99), `p99 ${p99} ms`);
});
