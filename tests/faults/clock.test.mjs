// The machine's clock is set: an hour on, an hour back, a day, to 1970, and it stands still. The server runs under libfaketime, which
// tells it another wall clock and leaves its steady one alone; the vehicles do not. Nobody is taken for silent, nobody who works is signed
// out, nobody who was signed out is in again, orders are driven, schedules come due once, and people are told.
import assert from "node:assert/strict";
import { existsSync, readdirSync, renameSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";

const VEHICLE = "TP-01";
const HOUR_s = 3600, DAY_s = 24 * HOUR_s;
// The right time of this test is two days on: a day back is then no time before the program was built, which no server believes.
const kRight_s = 2 * DAY_s;
const now = () => Date.now() + 1000 * kRight_s;
const systems = [];
after(() => Promise.all(systems.map((system) => system.stop())));

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

function libfaketime() {
  const folders = readdirSync("/usr/lib").map((name) => join("/usr/lib", name, "faketime"));
  const library = ["/usr/lib/faketime", ...folders].map((folder) => join(folder, "libfaketimeMT.so.1")).find((file) => existsSync(file));
  assert.ok(library, "libfaketime is not installed: docker/packages has it, section test");
  return library;
}

/** The wall clock that the server is told. */
class WallClock {
  constructor(system) {
    this.file = join(system.directory, "wall-clock");
    this.env = { LD_PRELOAD: libfaketime(), FAKETIME_TIMESTAMP_FILE: this.file, FAKETIME_NO_CACHE: "1", FAKETIME_DONT_FAKE_MONOTONIC: "1", DONT_FAKE_MONOTONIC: "1", NO_FAKE_STAT: "1", TZ: "UTC" };
  }
  #tell(text) {
    writeFileSync(`${this.file}.new`, `${text}\n`);
    renameSync(`${this.file}.new`, this.file); // it is read at any moment
  }
  /** So many seconds ahead of the right time from now on. */
  ahead(s) {
    this.ahead_s = s;
    const offset_s = s + kRight_s;
    this.#tell(`${offset_s < 0 ? "" : "+"}${offset_s}`);
  }
  to1970() { this.ahead(-Math.floor(now() / 1000) + 600); }
  standStill() { this.#tell(new Date(now()).toISOString().slice(0, 19).replace("T", " ")); }
}

/** A browser that holds a session's cookie. */
class Person {
  static async signIn(system, name) {
    const person = new Person();
    person.client = new Client(system.url);
    const { status, headers, body } = await person.client.request("POST", "/api/v1/session", { body: { name, password: system.passwords.get(name) }, headers: { Origin: system.url } });
    assert.equal(status, 200, JSON.stringify(body));
    const [cookie] = headers.getSetCookie();
    assert.match(cookie, /Max-Age=\d+/); // counted by the browser: no date that depends on our clock
    assert.doesNotMatch(cookie, /Expires=/i);
    person.cookie = cookie.split(";")[0];
    return person;
  }
  async isIn() { return (await this.client.request("GET", "/api/v1/session", { headers: { Cookie: this.cookie } })).status === 200; }
}

const aheadOfMachine_s = async (client) => Number(/^pulseline_clock_ahead_milliseconds (\S+)$/m.exec((await client.request("GET", "/metrics")).body)[1]) / 1000;

/** Drives from station to station until told to stop; one order after the other. */
function keepDriving(client, system) {
  const work = { on: true, orders: 0 };
  work.done = (async () => {
    while (work.on) {
      const { at_station } = await client.get(`/api/v1/vehicles/${VEHICLE}`);
      const begin = now();
      const order = await client.order(VEHICLE, [at_station === system.plant.station(1).id ? 2 : 1], { "Idempotency-Key": `clock-${work.orders}` });
      // What is shown is the server's time: it may be a little behind or ahead, never an hour.
      assert.ok(Math.abs(Date.parse(order.created_at) - begin) < 20_000, `created at ${order.created_at}, it is ${new Date(begin).toISOString()}`);
      assert.equal((await client.untilEnded(order.id, 60)).state, "Ended");
      const { created_at, ended_at } = await client.get(`/api/v1/job-orders/${order.id}`);
      assert.ok(Date.parse(ended_at) > Date.parse(created_at));
      ++work.orders;
    }
  })();
  work.done.catch(() => {}); // told at the end
  return work;
}

const theSame = (events, type) => events.filter((event) => event.type === type);

function nobodyWasDisturbed(events) {
  assert.deepEqual(events.filter((e) => e.type === "vehicle.link" && e.params.to !== "live"), []);
  for (const type of ["vehicle.needs_resume", "vehicle.disconnected", "server.stood_still", "store.failed"]) assert.deepEqual(theSame(events, type), []);
  assert.deepEqual(events.filter((e) => e.type === "job_order.state" && ["Interrupted", "Aborted"].includes(e.params.to)), []);
  for (let i = 1; i < events.length; ++i) {
    assert.equal(events[i].seq, events[i - 1].seq + 1);
    assert.ok(Date.parse(events[i].at) >= Date.parse(events[i - 1].at), `event ${events[i].seq} is earlier than the one before`);
  }
}

test("a wall clock that is set to and fro", { timeout: 150_000 }, async (t) => {
  const system = await System.create("pulse-line");
  systems.push(system);
  system.prepareVehicles([VEHICLE]);
  const clock = new WallClock(system);

  // Eighty minutes ago somebody signed in and left.
  clock.ahead(-80 * 60);
  await system.startServer([], clock.env);
  const idle = await Person.signIn(system, "viewer");
  assert.ok(await idle.isIn());
  system.server.kill("SIGTERM");
  await system.server.ended;

  clock.ahead(0);
  await system.startServer([], clock.env);
  const client = new Client(system.url, system.apiToken);
  assert.ok(!(await idle.isIn()), "a session of eighty minutes without use has ended");
  const person = await Person.signIn(system, "operator");
  system.startAgent(VEHICLE, { sensing: "analytic", timeFactor: 10 });
  await client.untilReady(VEHICLE);
  const { needs_resume, last_event_seq } = await client.get("/api/v1/fleet");
  if (needs_resume.length > 0) await client.post("/api/v1/fleet/resume", { vehicles: needs_resume });
  const readyAt = (await client.get("/api/v1/fleet")).last_event_seq;
  const daily = new Date(now() + 8000).toISOString().slice(11, 19); // within the hour that the clock jumps over and back
  const schedule = await client.post("/api/v1/job-order-schedules", { name: "daily", daily_at: [daily], window_s: 3600, order: { vehicle: VEHICLE, steps: [{ station: 1 }] } });
  const made = async () => (await client.get(`/api/v1/job-order-schedules/${schedule.id}`)).made;
  const work = keepDriving(client, system);

  await t.test("while the server runs", async () => {
    const steps = [["an hour on", HOUR_s], ["an hour back", -HOUR_s], ["a day on", DAY_s], ["a day back", -DAY_s], ["1970"]];
    for (const [name, ahead_s] of steps) {
      if (name === "1970") clock.to1970();
      else clock.ahead(ahead_s);
      // The server's own figure moves: it does read this clock.
      await until(`${name}: the server sees it`, async () => Math.abs((await aheadOfMachine_s(client)) + clock.ahead_s) < 20, { timeout_s: 5 });
      const fleet = await until(`${name}: people are told`, async () => { const view = await client.get("/api/v1/fleet"); return Math.abs((view.clock?.ahead_s ?? 0) + clock.ahead_s) < 20 && view; }, { timeout_s: 5 });
      assert.ok(Math.abs(Date.parse(fleet.clock.since) - now()) < 60_000, `${name}: told since ${fleet.clock.since}`);
      assert.ok(await person.isIn(), `${name}: who works stays signed in`);
      assert.ok(!(await idle.isIn()), `${name}: who was signed out stays it`);
      const { orders } = work;
      await until(`${name}: an order is driven to its end`, async () => work.orders > orders || !(await pause(20)), { timeout_s: 20 });
    }
    clock.standStill();
    const { orders } = work;
    await pause(20_000); // the standstill itself
    assert.ok(work.orders > orders, "orders go on");
    const standing = await aheadOfMachine_s(client);
    assert.ok(standing > 15 && standing < 25, `the machine's clock stands still; the server is ${standing} s ahead`);
    assert.ok(await person.isIn() && !(await idle.isIn()));
    clock.ahead(0);
    await until("people are told that it is right again", async () => !(await client.get("/api/v1/fleet")).clock, { timeout_s: 5 });
  });

  work.on = false;
  await work.done;
  await until("the schedule has made its order", async () => (await made()) > 0, { timeout_s: 10 });
  assert.equal(await made(), 1, "six o'clock comes once a day");
  const events = await client.events(readyAt);
  nobodyWasDisturbed(events);
  assert.equal(theSame(events, "clock.agrees").length, 2, "when it comes to stand still it is right at first");
  const told = theSame(events, "clock.differs").map((event) => Math.round(-event.params.ahead_s / HOUR_s));
  assert.deepEqual(told.slice(0, 4), [1, -1, 24, -24], "each jump is told, once");
  assert.ok(told.length <= 7, `1970 once, the standstill as it grows: told ${told}`);

  await t.test("over a restart with the clock an hour back", async () => {
    const open = (await client.get("/api/v1/job-orders?limit=100")).items.filter((order) => !["Ended", "Aborted"].includes(order.state));
    for (const order of open) await client.untilEnded(order.id, 60);
    system.server.kill("SIGTERM");
    await system.server.ended;
    clock.ahead(-HOUR_s);
    await system.startServer([], clock.env);
    assert.ok(Math.abs(await aheadOfMachine_s(client)) < 10, "it starts by the machine's clock");
    assert.ok(await person.isIn(), "who works stays signed in");
    assert.ok(!(await idle.isIn()), "who was signed out stays it, although by this clock it was 20 minutes ago");
    const { next_at, made: orders } = await client.get(`/api/v1/job-order-schedules/${schedule.id}`);
    assert.equal(orders, 1);
    assert.ok(Date.parse(next_at) > now() + 1000 * HOUR_s, `today's order was made; the next one is due ${next_at}`);
  });

  await t.test("over a restart in 1970", async () => {
    system.server.kill("SIGTERM");
    await system.server.ended;
    clock.to1970();
    await system.startServer([], clock.env);
    assert.ok(await person.isIn());
    assert.ok(!(await idle.isIn()));
    await until("people are told", async () => (await client.get("/api/v1/fleet")).clock?.ahead_s > 50 * 365 * DAY_s, { timeout_s: 5 });
    const all = await client.events(last_event_seq);
    all.forEach((event, i) => assert.equal(event.seq, last_event_seq + 1 + i));
    assert.equal(theSame(all, "clock.was_ahead").length, 1, "only the clock that went back an hour");
    await client.untilReady(VEHICLE);
    await client.post("/api/v1/fleet/resume", { vehicles: [VEHICLE] });
    const order = await client.order(VEHICLE, [2]);
    assert.equal((await client.untilEnded(order.id, 60)).state, "Ended");
  });
});
