// Many connections that do nothing, read nothing or say everything slowly, against the real server on the loopback.
// The quick form takes a minute; PULSELINE_STRANGERS=10 makes ten times as many of each, as every night.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { join } from "node:path";
import { after, afterEach, before, test } from "node:test";
import { System, until } from "../harness/processes.mjs";

const SCALE = Number(process.env.PULSELINE_STRANGERS ?? 1);
let system;
const sockets = new Set();

function open(bytes, { reads = true } = {}) {
  return new Promise((done, failed) => {
    const socket = connect(system.port, "127.0.0.1", () => { socket.opened_ms = performance.now(); socket.write(bytes); done(socket); });
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

const bearer = () => `Authorization: Bearer ${system.apiToken}\r\n`;
const upgrade = () => `GET /api/v1/stream HTTP/1.1\r\nHost: x\r\n${bearer()}Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n`;
const get = (path) => fetch(system.url + path, { headers: { Authorization: `Bearer ${system.apiToken}`, Connection: "close" } });
const metric = async (name) => Number(new RegExp(`^${name} (.*)$`, "m").exec(await (await get("/metrics")).text())[1]);
const residentMB = () => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${system.server.pid}/status`, "utf8"))[1]) / 1024;

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
  const config = join(system.directory, "server.toml");
  writeFileSync(config, "[limits]\nstreams_per_user = 20000\n");
  await system.startServer(["--config", config]);
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
  for (const socket of good) socket.on("data", (data) => { if (data[0] === 0x89) socket.write(Buffer.from([0x8a, 0x80, 0, 0, 0, 0])); });
  const health = watchHealth();
  // Nobody answers the server's pings but the good ones.
  await until("those that never read are gone", async () => await metric("pulseline_stream_clients") <= good.length, { timeout_s: 40 });
  const { p50, p99 } = await health();

  console.log(`${count} WebSockets in ${opened_s.toFixed(1)} s, ${each_kB.toFixed(0)} KB each; /healthz p50 ${p50.toFixed(0)} ms, p99 ${p99.toFixed(0)} ms`);
  // A sanitizer's own memory is not the server's.
  if (!process.env.PULSELINE_SANITIZED) assert.ok(each_kB <= 15, `${each_kB} KB each`);
  assert.equal(good.filter((socket) => socket.isOver).length, 0, "those that read stay");
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
