// ./dev bench main: how long an order takes to be accepted (committed) and to be with the agent, and what the
// server weighs. "With the agent" is the moment the agent's own log says the order is here.
import { mkdirSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { Agent, request } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Client } from "../harness/client.mjs";
import { BUILD, System, until } from "../harness/processes.mjs";
import { manyVehicles } from "./many_vehicles.mjs";

const ORDERS = Number(process.argv[2] ?? 500);  // of ten agents and more; one agent drives a tenth of them
const AT_WORK = 16;  // vehicles that have an order at any moment
const rss_kb = (pid) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, "utf8"))[1]);
const percentile = (values, p) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.ceil(p * values.length) - 1)];
const summary = (values) => ({ n: values.length, p50_ms: +percentile(values, 0.5).toFixed(2), p99_ms: +percentile(values, 0.99).toFixed(2), max_ms: +Math.max(...values).toFixed(2) });

/** Memory once it has stopped growing: the same in ten looks, 100 ms apart. */
async function settledRss(pid) {
  let last = 0, same = 0;
  await until("the server's memory settles", () => {
    const now = rss_kb(pid);
    same = now === last ? same + 1 : 0;
    last = now;
    return same >= 10;
  }, { timeout_s: 60, every_ms: 100 });
  return last;
}

/** Follows the event stream: `when(type, order)` is the moment an event of that order came. Nothing polls, so
 *  that the client does not measure itself. */
async function follow(client) {
  const came = new Map(), abort = new AbortController();
  const slot = (type, order) => {
    const key = `${type} ${order}`;
    if (!came.has(key)) {
      const made = {};
      made.promise = new Promise((done) => { made.done = done; });
      came.set(key, made);
    }
    return came.get(key);
  };
  const { last_event_seq } = await client.get("/api/v1/fleet");
  const response = await fetch(`${client.url}/api/v1/events?after=${last_event_seq}`, { headers: { Authorization: `Bearer ${client.token}` }, signal: abort.signal });
  const take = ({ type, order, params }) => {
    if (!order) return;
    slot(type === "job_order.state" ? `${type} ${params.to}` : type, order).done(performance.now());
  };
  (async () => {
    let text = "";
    const decoder = new TextDecoder();
    for await (const chunk of response.body) {
      text += decoder.decode(chunk, { stream: true });
      for (let end; (end = text.indexOf("\n\n")) >= 0; text = text.slice(end + 2)) {
        const data = text.slice(0, end).split("\n").filter((l) => l.startsWith("data:")).map((l) => l.slice(5)).join("");
        if (data) take(JSON.parse(data));
      }
    }
  })().catch(() => {});
  return { when: (type, order) => slot(type, order).promise, stop: () => abort.abort() };
}

/** Sends orders as an MES does: one after the other over a connection that stays open. fetch() would add a
 *  millisecond or two of its own. */
function orderSender(client) {
  const agent = new Agent({ keepAlive: true, maxSockets: 1 });
  let last = Promise.resolve();
  const headers = { Authorization: `Bearer ${client.token}`, "Content-Type": "application/json" };
  const send = (method, path, body) => new Promise((done, fail) => {
    const asked = request(client.url + path, { method, agent, headers }, (response) => {
      let text = "";
      response.setEncoding("utf8").on("data", (part) => { text += part; }).on("end", () =>
        response.statusCode < 300 ? done(JSON.parse(text)) : fail(new Error(`${method} ${path}: ${response.statusCode} ${text}`)));
    });
    asked.on("error", fail).setNoDelay(true);
    asked.end(body && JSON.stringify(body));
  });
  return {
    open: () => send("GET", "/api/v1/fleet"),
    /** Milliseconds from sending to the answer, and the order. */
    order: (vehicle, station) => {
      const answer = last.then(async () => {
        const begin = performance.now();
        const order = await send("POST", "/api/v1/job-orders", { vehicle, steps: [{ station }] });
        return { order, begin, accepted: performance.now() };
      });
      last = answer.catch(() => {});
      return answer;
    },
    close: () => agent.destroy(),
  };
}

/** Milliseconds from an order's acceptance to its first leg's arrival at the agent; 0 where the agent was faster than the answer. */
async function waysToTheAgent(client, sent, log) {
  const came = new Map();
  for (const [, time, leg] of log.matchAll(/^(\S+Z) info order\.here vehicle=\S+ order=(\S+) update=0$/gm)) came.set(leg, Date.parse(time));
  const ways = [];
  for (const { order, accepted } of sent) {
    const leg = (await client.get(`/api/v1/job-orders/${order}`)).steps[0].leg;
    if (!came.has(leg)) throw new Error(`the agent's log does not have leg ${leg}`);
    ways.push(Math.max(0, came.get(leg) - performance.timeOrigin - accepted));
  }
  return ways;
}

/** The server's own times of releases: the bounds below which half and 99 % of them lie. */
function releases(metrics) {
  const times = {};
  for (const until of ["decided", "stored"]) {
    const buckets = [...metrics.matchAll(new RegExp(`^pulseline_release_seconds_bucket\\{until="${until}",le="([^"]+)"\\} (\\d+)$`, "gm"))].map(([, le, n]) => ({ le_ms: le === "+Inf" ? Infinity : 1000 * Number(le), n: Number(n) }));
    const count = buckets.at(-1).n, below = (share) => buckets.find(({ n }) => n >= share * count).le_ms;
    times[until] = { n: count, p50_below_ms: below(0.5), p99_below_ms: below(0.99) };
  }
  return times;
}

/** A promise that must come true within seconds. */
function within(seconds, what, promise) {
  let timer;
  const late = new Promise((_, fail) => { timer = setTimeout(() => fail(new Error(`waited ${seconds} s in vain for: ${what}`)), seconds * 1000); });
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

async function measure(count) {
  const file = join(mkdtempSync(join(tmpdir(), "pulseline-bench-")), "plant.json");
  writeFileSync(file, JSON.stringify(manyVehicles(count)));
  const system = await System.create(file);
  const ids = system.plant.model.vehicles.map((v) => v.id);
  system.prepareVehicles(ids);
  const started = performance.now();
  await system.startServer();
  const start_ms = performance.now() - started;
  const client = new Client(system.url, system.apiToken);
  const rss_rest_kb = await settledRss(system.server.pid);
  const list = join(system.directory, "vehicles");
  writeFileSync(list, ids.map((id) => { const v = system.plant.vehicle(id); return `${v.manufacturer}/${v.serial_number} ${system.tokenOf(id)}\n`; }).join(""));
  system.start(join(BUILD, "pulseline-agent"), ["--server", `ws://127.0.0.1:${system.port}`, "--vehicles", list, "--world", file, "--seed", "1", "--time-factor", "10", "--sensing", "analytic"], "agents");
  await until("all agents are ready", async () => (await client.get("/api/v1/vehicles")).items.every((v) => v.link === "live" && v.pose_known), { timeout_s: 60, every_ms: 200 });
  const rss_agents_kb = rss_kb(system.server.pid);
  const events = await follow(client);
  const accept = [], sent = [];
  const at = new Map(ids.map((id) => [id, 0]));
  let left = count === 1 ? ORDERS / 10 : ORDERS;
  const workers = Math.min(AT_WORK, count);
  const sender = orderSender(client);
  await sender.open();
  await Promise.all(Array.from({ length: workers }, async (_, worker) => {
    for (let i = worker; left > 0; i += workers) {
      --left;
      const id = ids[i % count], index = ids.indexOf(id);
      at.set(id, 1 - at.get(id));
      const { order, begin, accepted } = await sender.order(id, 2 * index + at.get(id) + 1);
      accept.push(accepted - begin);
      sent.push({ order: order.id, accepted });
      await within(60, "the order ends", events.when("job_order.state Ended", order.id));
    }
  }));
  const rss_end_kb = rss_kb(system.server.pid);
  const release = releases(await (await fetch(`${client.url}/metrics`, { headers: { Authorization: `Bearer ${client.token}` } })).text());
  const dispatch = await waysToTheAgent(client, sent, readFileSync(join(system.directory, "agents.log"), "utf8"));
  events.stop();
  sender.close();
  await system.stop();
  return { agents: count, start_to_ready_ms: Math.round(start_ms), accept: summary(accept), dispatch: summary(dispatch), release, rss_rest_mb: +(rss_rest_kb / 1024).toFixed(1), rss_agents_mb: +(rss_agents_kb / 1024).toFixed(1), rss_end_mb: +(rss_end_kb / 1024).toFixed(1), growth_kb: rss_agents_kb - rss_rest_kb };
}

const results = [];
for (const count of (process.argv[3] ?? "1,10,100").split(",").map(Number)) {
  const result = await measure(count);
  // What the first agent adds holds code pages that are touched once; the others show what an agent weighs.
  if (results.length > 0) result.kb_per_agent = +((result.growth_kb - results[0].growth_kb) / (count - results[0].agents)).toFixed(1);
  results.push(result);
  console.log(JSON.stringify(result));
}
mkdirSync(join(BUILD, "bench"), { recursive: true });
writeFileSync(join(BUILD, "bench/main.json"), JSON.stringify({ date: new Date().toISOString(), orders: ORDERS, results }, null, 2));
