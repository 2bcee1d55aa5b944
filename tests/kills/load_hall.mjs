// One server under load that is killed again and again: vehicles, clients that order, pause, resume and cancel, the
// person who lets vehicles go on, and the book of every answer, held against the database after each death.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { manyVehicles } from "../bench/many_vehicles.mjs";
import { Client } from "../harness/client.mjs";
import { BUILD, System, until } from "../harness/processes.mjs";
import { pick, randomOf } from "../harness/random.mjs";

const VEHICLES = 6, CLIENTS = 3, OPEN_PER_VEHICLE = 2;
const FINAL = ["Ended", "Aborted"];

export class LoadHall {
  orders = new Map();  // by Idempotency-Key: what was asked and the most that was answered
  papers = new Map();  // by client: what its load was said to weigh, last, and last acknowledged
  seen = new Map();    // events the stream has shown, by sequence number
  counts = { kills: 0, created: 0, weighed: 0, unanswered: 0, changes: 0, refused: 0, released: 0, replayed: 0, events_replayed: 0, given_up: 0 };
  loading = false;
  next = 0;

  static async begin(name, seed) {
    const hall = new LoadHall();
    hall.name = name;
    hall.random = randomOf(seed);
    const folder = mkdtempSync(join(tmpdir(), "pulseline-kills-"));
    const file = join(folder, "plant.json");
    writeFileSync(file, JSON.stringify(manyVehicles(VEHICLES)));
    hall.system = await System.create(file, { users: [] });
    hall.vehicles = hall.system.plant.model.vehicles.map((v) => v.id);
    hall.system.prepareVehicles(hall.vehicles);
    hall.client = new Client(hall.system.url, hall.system.apiToken);
    const list = join(hall.system.directory, "vehicles");
    writeFileSync(list, hall.vehicles.map((id) => `load/${id} ${hall.system.tokenOf(id)}\n`).join(""));
    hall.system.start(join(BUILD, "pulseline-agent"), ["--server", `ws://127.0.0.1:${hall.system.port}`, "--vehicles", list, "--world", file,
      "--seed", String(seed), "--time-factor", "20", "--sensing", "analytic"], "agents");
    return hall;
  }

  // --- what goes on while the server lives -------------------------------------------------------
  /** An answer, or undefined when the server died over it. */
  async ask(method, path, options) {
    try {
      return await this.client.request(method, path, options);
    } catch {
      return undefined;
    }
  }

  /** Asks for an order, the first time or again; whether it was answered is written down. */
  async create(key) {
    const known = this.orders.get(key);
    const answer = await this.ask("POST", "/api/v1/job-orders", { body: known.body, headers: { "Idempotency-Key": key } });
    if (!answer) { known.outcome = "unknown"; ++this.counts.unanswered; return; }
    if (answer.status === 201) {
      if (known.id) assert.equal(answer.body.id, known.id, `${key} became two orders`);
      else ++this.counts.created;
      Object.assign(known, { outcome: "accepted", id: answer.body.id, revision: Math.max(known.revision, answer.body.revision) });
      return;
    }
    assert.ok(known.outcome !== "accepted", `${key} was accepted before, now ${answer.status} ${JSON.stringify(answer.body)}`);
    // Once unanswered, it may be stored whatever a later answer says.
    if (known.outcome !== "unknown") known.outcome = "refused";
    ++this.counts.refused;
    assert.ok([409, 422, 503].includes(answer.status), `${answer.status} ${JSON.stringify(answer.body)}`);
  }

  async change(known) {
    const verb = pick(this.random, ["pause", "resume", "resume", "cancel"]);
    const answer = await this.ask("POST", `/api/v1/job-orders/${known.id}/${verb}`, { body: {} });
    if (!answer) { ++this.counts.unanswered; return; }
    if (answer.status === 202) {
      ++this.counts.changes;
      known.revision = Math.max(known.revision, answer.body.revision);
      if (FINAL.includes(answer.body.state)) known.final = true;
      if (verb === "cancel") known.cancelled = true;
    } else {
      ++this.counts.refused;
      assert.ok([409, 412, 503].includes(answer.status), `${verb}: ${answer.status} ${JSON.stringify(answer.body)}`);
    }
  }

  /** What the client's own load weighs is said anew, 1 kg more each time. */
  async weigh(number) {
    const known = this.papers.get(number) ?? { said_kg: 0, acknowledged_kg: 0 };
    this.papers.set(number, known);
    ++known.said_kg;
    const body = { mass_kg: known.said_kg, vehicle_types: ["carrier"] };
    const answer = await this.ask("PUT", `/api/v1/loads/L-${number}`, { body });
    if (!answer) { ++this.counts.unanswered; return; }
    if ([200, 201].includes(answer.status)) { known.acknowledged_kg = known.said_kg; ++this.counts.weighed; return; }
    ++this.counts.refused;
    assert.equal(answer.status, 503, JSON.stringify(answer.body));
  }

  async clientLoop(number) {
    while (this.loading) {
      if (this.random() < 0.2) await this.weigh(number);
      const mine = [...this.orders].filter(([, o]) => o.client === number);
      const lost = mine.find(([, o]) => o.outcome === "unknown");
      const open = mine.filter(([, o]) => o.outcome === "accepted" && !o.final);
      const index = Math.floor(this.random() * VEHICLES);
      const busy = [...this.orders.values()].filter((o) => o.index === index && o.outcome !== "refused" && !o.final).length;
      if (lost) await this.create(lost[0]);
      else if (open.length > 0 && this.random() < 0.35) await this.change(pick(this.random, open)[1]);
      else if (busy < OPEN_PER_VEHICLE) {
        const key = `${this.name}-${++this.next}`;
        const first = this.random() < 0.5 ? 1 : 2;
        const stations = this.random() < 0.5 ? [first] : [first, 3 - first];
        this.orders.set(key, { client: number, index, outcome: "new", revision: 0,
          body: { vehicle: this.vehicles[index], client_order_id: key, steps: stations.map((s) => ({ station: 2 * index + s })) } });
        await this.create(key);
      }
      await new Promise((done) => setTimeout(done, 5 + 15 * this.random()));
    }
  }

  /** Looks at the vehicles and lets them go on; notes which orders are over. */
  async person() {
    while (this.loading) {
      const fleet = (await this.ask("GET", "/api/v1/fleet"))?.body;
      if (fleet?.needs_resume?.length > 0) {
        const live = (await this.ask("GET", "/api/v1/vehicles"))?.body?.items?.filter((v) => v.link === "live" && v.needs_resume).map((v) => v.id) ?? [];
        if (live.length > 0) await this.ask("POST", "/api/v1/fleet/resume", { body: { vehicles: live } });
      }
      const newest = (await this.ask("GET", "/api/v1/job-orders?limit=100"))?.body?.items ?? [];
      for (const order of newest) {
        const known = this.orders.get(order.client_order_id);
        if (known && FINAL.includes(order.state)) known.final = true;
      }
      await new Promise((done) => setTimeout(done, 40));
    }
  }

  /** What is released as an event is stored: it may never change or vanish. */
  async readEvents() {
    while (this.loading) {
      try {
        const after = Math.max(0, ...this.seen.keys());
        const response = await fetch(`${this.client.url}/api/v1/events?after=${after}`, { headers: { Authorization: `Bearer ${this.client.token}` }, signal: this.listening.signal });
        let text = "";
        const decoder = new TextDecoder();
        for await (const chunk of response.body) {
          text += decoder.decode(chunk, { stream: true });
          for (let end; (end = text.indexOf("\n\n")) >= 0; text = text.slice(end + 2)) {
            const data = text.slice(0, end).split("\n").find((l) => l.startsWith("data:"));
            if (!data) continue;
            const event = JSON.parse(data.slice(5));
            this.seen.set(event.seq, [event.type, event.order ?? ""]);
            ++this.counts.released;
          }
        }
      } catch { /* it died or is not there yet */ }
      await new Promise((done) => setTimeout(done, 20));
    }
  }

  startLoad() {
    this.loading = true;
    this.listening = new AbortController();
    this.working = Promise.all([this.person(), this.readEvents(), ...Array.from({ length: CLIENTS }, (_, i) => this.clientLoop(i))]);
    this.working.catch(() => {});  // told by stopLoad
  }
  async stopLoad() {
    this.loading = false;
    this.listening.abort();
    await this.working;
  }

  // --- its deaths --------------------------------------------------------------------------------
  /** Starts the server to die at a named point; it may die before it is ready. */
  startServer(crashAt) {
    const ready = this.system.startServer([], crashAt ? { PULSELINE_CRASH_AT: crashAt } : {});
    ready.catch(() => {});
    return ready;
  }

  async ended(what, timeout_s) {
    const { server } = this.system;
    await until(what, () => server.over, { timeout_s, every_ms: 5 });
    assert.equal(server.over.signal, "SIGKILL", `${what}: it ended with ${JSON.stringify(server.over)}\n${this.system.log("server")}`);
    ++this.counts.kills;
  }

  /** One life and death: `plan` is {after_ms} or {point, passage, stop}. */
  async die(plan) {
    const ready = this.startServer(plan.point && `${plan.point}:${plan.passage}`);
    this.startLoad();
    if (!plan.point) {
      await ready;
      await new Promise((done) => setTimeout(done, plan.after_ms));
      this.system.server.kill("SIGKILL");
    } else if (plan.stop) {
      await ready;
      await new Promise((done) => setTimeout(done, plan.after_ms));
      this.system.server.kill("SIGTERM");
    }
    try {
      await this.ended(plan.point ? `the server dies at ${plan.point}:${plan.passage}` : "the server is killed", 30);
    } finally {
      await this.stopLoad();
    }
    this.checkBooks();
  }

  // --- the checker -------------------------------------------------------------------------------
  /** Reads a copy, so that the server itself has to recover the file. */
  stored() {
    const folder = join(this.system.directory, "copy");
    rmSync(folder, { recursive: true, force: true });
    mkdirSync(folder);
    for (const end of ["", "-wal"]) {
      if (existsSync(this.system.database + end)) copyFileSync(this.system.database + end, join(folder, `p.db${end}`));
    }
    this.checkJournal(join(folder, "p.db"));
    return JSON.parse(execFileSync(join(BUILD, "stored"), ["check", join(folder, "p.db")], { encoding: "utf8", maxBuffer: 1 << 28 }));
  }

  /** Its snapshots and journal replay to what is stored, to the last byte. */
  checkJournal(file) {
    const { inputs, events, difference } = JSON.parse(execFileSync(join(BUILD, "pulseline"), ["journal", "verify", "--db", file, "--json"], { encoding: "utf8" }));
    assert.equal(difference, null, `journal: ${JSON.stringify(difference)}`);
    this.counts.replayed += inputs;
    this.counts.events_replayed += events;
  }

  /** Either outcome of what was not answered, never both; all of what was. */
  checkBooks() {
    const { faults, orders, loads, events } = this.stored();
    assert.deepEqual(faults, []);
    for (const [number, { said_kg, acknowledged_kg }] of this.papers) {
      const stored_kg = Number(loads.find(({ id }) => id === `L-${number}`)?.mass_kg ?? 0);
      assert.ok(stored_kg >= acknowledged_kg && stored_kg <= said_kg, `load L-${number}: acknowledged ${acknowledged_kg} kg, said ${said_kg}, stored ${stored_kg}`);
    }
    const byKey = new Map();
    for (const order of orders) {
      assert.ok(!byKey.has(order.key), `two orders of key ${order.key}`);
      byKey.set(order.key, order);
      const known = this.orders.get(order.key);
      assert.ok(known, `nobody asked for order ${JSON.stringify(order)}`);
      assert.notEqual(known.outcome, "refused", `${order.key} was refused, yet it is stored`);
    }
    for (const [key, known] of this.orders) {
      const order = byKey.get(key);
      if (known.outcome !== "accepted") continue;
      assert.ok(order, `acknowledged order ${key} is lost`);
      assert.equal(order.id, known.id);
      assert.ok(Number(order.revision) >= known.revision, `${key}: acknowledged revision ${known.revision}, stored ${order.revision}`);
      if (known.cancelled) assert.ok(Number(order.cancel_requested) === 1 || FINAL.includes(order.state), `the acknowledged cancel of ${key} is lost`);
      if (known.final) assert.ok(FINAL.includes(order.state), `${key} had ended and is open again`);
    }
    for (const [seq, event] of this.seen) assert.deepEqual(events[seq - 1], event, `event ${seq} was shown and is not what is stored`);
  }

  /** All that is left comes to its end, once. */
  async finish() {
    await this.startServer();
    this.loading = true;
    const person = this.person();
    for (const [key, known] of this.orders) {
      if (known.outcome === "unknown") await this.create(key);
    }
    let left = [];
    await until(() => `${this.name}: every order ends; left ${left.join("; ")}`, async () => {
      let open = 0;
      left = [];
      for (const known of this.orders.values()) {
        if (known.outcome !== "accepted" || known.final) continue;
        ++open;
        await this.ask("POST", `/api/v1/job-orders/${known.id}/resume`, { body: {} });
        const order = (await this.ask("GET", `/api/v1/job-orders/${known.id}`))?.body;
        // A vehicle that was stopped often on its way may have lost sight of its codes. Nobody drives it there by hand here.
        if (order?.reason?.code === "stop_not_measured") known.unmeasured = (known.unmeasured ?? 0) + 1;
        if (known.unmeasured >= 10 && !known.cancelled) {
          const answer = await this.ask("POST", `/api/v1/job-orders/${known.id}/cancel`, { body: {} });
          if (answer?.status === 202) { known.cancelled = true; ++this.counts.given_up; }
        }
        if (FINAL.includes(order?.state)) known.final = true;
        else left.push(`${order?.name} ${order?.state} ${order?.vehicle ?? ""} ${JSON.stringify(order?.reason)}`);
      }
      return open === 0;
    }, { timeout_s: 180, every_ms: 100 });
    this.loading = false;
    await person;
    await this.system.kill(this.system.server);
    this.checkBooks();
  }
}
