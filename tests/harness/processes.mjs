// Starts the real programs for tests: server and agents as child processes, each test in a directory of its own.
import { execFileSync, spawn } from "node:child_process";
import { closeSync, existsSync, fstatSync, mkdtempSync, openSync, readFileSync, readSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { angleBetween } from "./client.mjs";

export const ROOT = resolve(import.meta.dirname, "../..");
export const BUILD = process.env.PULSELINE_BUILD ?? join(ROOT, "build");
const SERVER = join(BUILD, "pulseline");
const AGENT = join(BUILD, "pulseline-agent");

/** Waits for a condition by looking again every few milliseconds; fails loudly, never silently. */
export async function until(what, condition, { timeout_s = 30, every_ms = 20 } = {}) {
  const end = Date.now() + timeout_s * 1000;
  for (;;) {
    const value = await condition();
    if (value) return value;
    if (Date.now() > end) throw new Error(`waited ${timeout_s} s in vain for: ${typeof what === "function" ? await what() : what}`);
    await new Promise((done) => setTimeout(done, every_ms));
  }
}

/** A port nobody listens on now. */
export async function freePort() {
  const probe = createServer();
  await new Promise((done) => probe.listen(0, "127.0.0.1", done));
  const { port } = probe.address();
  await new Promise((done) => probe.close(done));
  return port;
}

export class Plant {
  constructor(name) {
    this.file = name.includes("/") ? name : join(ROOT, "db/plants", `${name}.json`);
    this.model = JSON.parse(readFileSync(this.file, "utf8"));
  }
  vehicle(id) {
    return this.model.vehicles.find((v) => v.id === id);
  }
  station(number) {
    return this.model.stations.find((s) => s.number === number);
  }
}

const linesOf = (file) => existsSync(file) ? readFileSync(file, "utf8").split("\n").filter((line) => line.endsWith("}")).map((line) => JSON.parse(line)) : [];

/** One server with its database, users and vehicle tokens, and any number of agents. */
export class System {
  constructor(plant, directory) {
    this.plant = plant;
    this.directory = directory;
    this.database = join(directory, "pulseline.db");
    this.tokens = new Map();
    this.passwords = new Map();
    this.agents = new Map();
    this.children = new Set();
    this.host = "127.0.0.1";
    this.scheme = "http";
    this.onVehicles = []; // before the agents' command line, where they run on a host of their own
  }

  static async create(plantName, { users = ["operator", "viewer"] } = {}) {
    const system = new System(new Plant(plantName), mkdtempSync(join(tmpdir(), "pulseline-test-")));
    system.port = await freePort();
    system.cli(["plant", "import", system.plant.file]);
    for (const role of users) {
      const password = `test-password-of-${role}`;
      system.cli(["user", "add", role, "--role", role, "--password-stdin"], password);
      system.passwords.set(role, password);
    }
    system.apiToken = system.cli(["token", "create", "--role", "operator", "--scope", "api"]).trim();
    return system;
  }

  cli(args, input = "") {
    return execFileSync(SERVER, [...args, "--db", this.database], { input, encoding: "utf8" });
  }

  get url() {
    return `${this.scheme}://${this.host}:${this.port}`;
  }
  get truthLog() {
    return join(this.directory, "truth.jsonl");
  }

  start(program, args, name, env = {}) {
    const log = openSync(join(this.directory, `${name}.log`), "a");
    const child = spawn(program, args, { stdio: ["ignore", log, log], cwd: ROOT, env: { ...process.env, ...env } });
    this.children.add(child);
    child.ended = new Promise((done) => child.on("exit", (code, signal) => { child.over = { code, signal }; this.children.delete(child); done(child.over); }));
    return child;
  }

  async startServer(extra = [], env = {}) {
    this.server = this.start(SERVER, ["serve", "--db", this.database, "--listen", `${this.host}:${this.port}`, ...extra], "server", env);
    await until(() => `server ready; its log:\n${this.log("server")}`, async () => {
      if (this.server.over) throw new Error(`the server ended: ${JSON.stringify(this.server.over)}\n${this.log("server")}`);
      try { return (await fetch(`${this.url}/readyz`)).ok; } catch { return false; }
    }, { timeout_s: 20, every_ms: 10 });
    return this.server;
  }

  tokenOf(id) {
    if (!this.tokens.has(id)) {
      const { manufacturer, serial_number } = this.plant.vehicle(id);
      this.tokens.set(id, this.cli(["token", "create", "--vehicle", `${manufacturer}/${serial_number}`]).trim());
    }
    return this.tokens.get(id);
  }

  /** Tokens are made before the server holds the database. */
  prepareVehicles(ids) {
    for (const id of ids) this.tokenOf(id);
  }

  startAgent(id, { seed = 1, timeFactor = 10, sensing = "rendered", world = this.plant.file, extra = [] } = {}) {
    const { manufacturer, serial_number } = this.plant.vehicle(id);
    const [program, ...before] = [...this.onVehicles, AGENT];
    const agent = this.start(program, [...before, "--server", this.url.replace("http", "ws"), "--vehicle", `${manufacturer}/${serial_number}`, "--token", this.tokenOf(id),
      "--world", world, "--seed", String(seed), "--truth-log", `${this.truthLog}.${id}`, "--time-factor", String(timeFactor), "--sensing", sensing, ...extra], `agent-${id}`);
    this.agents.set(id, agent);
    return agent;
  }

  /** The simulated machine of a vehicle behind the protocol of server/agent/MACHINE.md; for an agent's `--machine`. `pictures`: a folder for its cameras'. */
  async startMachine(id, { seed = 1, port = 0, world = this.plant.file, faults = [], pictures } = {}) {
    const name = `machine-${id}`, listening = /machine\.listening .*port="?(\d+)/g;
    const before = [...this.log(name).matchAll(listening)].length;
    const machine = this.start(AGENT, ["machine", "--world", world, "--vehicle", id, "--listen", `tcp://127.0.0.1:${port}`, "--seed", String(seed),
      "--truth-log", `${this.truthLog}.${id}`, ...faults.flatMap((fault) => ["--fault", fault]), ...(pictures ? ["--pictures", pictures] : [])], name);
    machine.port = await until(() => `machine ready; its log:\n${this.log(name)}`, () => {
      if (machine.over) throw new Error(`the machine ended: ${this.log(name)}`);
      return Number([...this.log(name).matchAll(listening)][before]?.[1]);
    }, { timeout_s: 20, every_ms: 10 });
    return machine;
  }

  /** A vehicle's program that knows no simulated world, driving its machine over TCP. */
  async startOverTcp(id, { seed = 1, timeFactor = 10, world, extra = [], faults = [], pictures } = {}) {
    const machine = await this.startMachine(id, { seed, world, faults, pictures });
    // The host of a test lets nobody run every 10 ms; how late a cycle may be is the bench's.
    this.startAgent(id, { seed, timeFactor, world, extra: ["--machine", `tcp://${this.host}:${machine.port}`, "--machine-watchdog-s", "3",
      "--belief-log", this.beliefLog(id), ...extra] });
    return machine;
  }

  /** All in one program: they stand in one world and see each other, and write one truth log. */
  startAgents(ids, { seed = 1, timeFactor = 10, sensing = "rendered", extra = [] } = {}) {
    const list = join(this.directory, "vehicles");
    writeFileSync(list, ids.map((id) => { const { manufacturer, serial_number } = this.plant.vehicle(id); return `${manufacturer}/${serial_number} ${this.tokenOf(id)}\n`; }).join(""), { mode: 0o600 });
    const agent = this.start(AGENT, ["--server", this.url.replace("http", "ws"), "--vehicles", list, "--world", this.plant.file, "--seed", String(seed),
      "--truth-log", this.truthLog, "--time-factor", String(timeFactor), "--sensing", sensing, ...extra], "agents");
    for (const id of ids) this.agents.set(id, agent);
    return agent;
  }

  /** The true movement of a vehicle, as the simulated world wrote it down. */
  truth(id) {
    return linesOf(`${this.truthLog}.${id}`);
  }
  /** Of a vehicle over TCP: what its program believed, line by line, with where it truly was then, of which only its machine knows. Both name the cycle of
   *  set points that they speak of, so that no clock and no delay comes between them; from one line of the machine to the next it went straight on. */
  truthWithBelief(id) {
    const truth = this.truth(id);
    let next = 0;
    return linesOf(this.beliefLog(id)).flatMap((line) => {
      while (next < truth.length && truth[next].cycle <= line.cycle) ++next;
      const [a, b] = [truth[next - 1], truth[next]];
      if (!a) return [];
      const share = a.moving && b ? (line.cycle - a.cycle) / (b.cycle - a.cycle) : 0; // the machine tells at once that it moves off
      const between = (from, to) => from + share * (to - from);
      const turned = share && share * angleBetween(b.heading_rad, a.heading_rad);
      return [{ ...line, x_m: between(a.x_m, b?.x_m ?? a.x_m), y_m: between(a.y_m, b?.y_m ?? a.y_m), heading_rad: a.heading_rad + turned }];
    });
  }
  beliefLog(id) {
    return join(this.directory, `belief.jsonl.${id}`);
  }
  /** Its newest whole line; tests ask every few milliseconds, so only the end of the file is read. */
  lastTruth(id) {
    const file = `${this.truthLog}.${id}`;
    if (!existsSync(file)) return undefined;
    const log = openSync(file, "r");
    try {
      const { size } = fstatSync(log), tail = Buffer.alloc(Math.min(size, 2048));
      readSync(log, tail, 0, tail.length, size - tail.length);
      const line = tail.toString("utf8").split("\n").findLast((text) => text.startsWith("{") && text.endsWith("}"));
      return line && JSON.parse(line);
    } finally {
      closeSync(log);
    }
  }

  log(name) {
    const file = join(this.directory, `${name}.log`);
    return existsSync(file) ? readFileSync(file, "utf8").slice(-4000) : "";
  }

  async kill(child) {
    child.kill("SIGKILL");
    await child.ended;
  }

  async stop() {
    for (const child of this.children) child.kill("SIGTERM");
    const patience = setTimeout(() => { for (const child of this.children) child.kill("SIGKILL"); }, 5000);
    await Promise.all([...this.children].map((child) => child.ended));
    clearTimeout(patience);
  }
}
