// kill -9 of the server at 8 and of an agent at 14 points of a drive: no acknowledged order is lost or doubled,
// nothing moves past its released base until a person allows it, and after that the drive ends.
// The two kinds of death run side by side, each with a server, a database and a vehicle of its own.
import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";

const SERVER_POINTS = Number(process.env.PULSELINE_KILL_POINTS ?? 8);  // load.test.mjs kills it far more often
const AGENT_POINTS = Number(process.env.PULSELINE_KILL_POINTS ?? 14);
const VEHICLE = "TP-01";
// A body brakes within what it was released; rounding of poses in the log aside.
const PAST_BASE_M = 0.05;

/** One server with one platform that is driven to and fro between stations 1 and 2. */
class Drives {
  at = 1;
  orders = [];

  static async begin() {
    const drives = new Drives();
    drives.system = await System.create("pulse-line");
    drives.system.prepareVehicles([VEHICLE]);
    await drives.system.startServer();
    drives.client = new Client(drives.system.url, drives.system.apiToken);
    drives.system.startAgent(VEHICLE, { seed: 3, sensing: "rendered" });
    await drives.client.untilReady(VEHICLE);
    return drives;
  }

  get truth() {
    return this.system.lastTruth(VEHICLE);
  }

  /** The person who looks at the vehicle, then allows it to move. */
  async allowToMove() {
    await this.client.untilVehicle(VEHICLE, (v) => v.link === "live", "is heard");
    await until("the resume is accepted", async () => {
      const answer = await this.client.request("POST", "/api/v1/fleet/resume", { body: { vehicles: [VEHICLE] } });
      return answer.status === 202;
    }, { timeout_s: 20, every_ms: 50 });
  }

  /** Where the vehicle stands for good: at the end of its base, and its truth log has said nothing new for longer than a
   *  slow machine takes over a picture and then over what it had been sent. */
  async untilStanding() {
    let last, since = 0;
    return until("the vehicle stands", () => {
      const { truth } = this;
      if (truth?.t_ms !== last?.t_ms) { last = truth; since = Date.now(); }
      return truth && !truth.moving && truth.last_node_seq === truth.base_end_seq && Date.now() - since > 1000 && truth;
    }, { timeout_s: 30, every_ms: 20 });
  }

  /** Starts a drive and waits until it has gone `share` of its way. */
  async driveTo(share) {
    this.at = this.at === 1 ? 2 : 1;
    const number = this.at, begin = this.truth;
    const { pose } = this.system.plant.station(number);
    const whole = Math.hypot(pose.x_m - begin.x_m, pose.y_m - begin.y_m);
    const order = await this.client.order(VEHICLE, [{ station: number, motion_mode: "linear" }], { "Idempotency-Key": `kill-${number}-${Date.now()}` });
    this.orders.push(order);
    await until(`the drive is at ${share}`, () => {
      const { truth } = this;
      return Math.hypot(truth.x_m - begin.x_m, truth.y_m - begin.y_m) >= share * whole || Math.hypot(truth.x_m - pose.x_m, truth.y_m - pose.y_m) < 0.02;
    }, { timeout_s: 40, every_ms: 5 });
    return { order, number };
  }

  async checkStoodStill(stood) {
    const later = await this.untilStanding();
    assert.ok(Math.hypot(later.x_m - stood.x_m, later.y_m - stood.y_m) <= PAST_BASE_M, "it moved without a person's act");
  }

  async checkEnded(order, number) {
    const ended = await this.client.untilEnded(order.id, 60);
    assert.equal(ended.state, "Ended", JSON.stringify(ended));
    const inside = (await this.client.stops(order.id)).filter((s) => s.inside);
    assert.equal(inside.length, 1, "one good stop, neither lost nor doubled");
    assert.equal(inside[0].number, number);
  }

  /** Events are gapless and every order of this test exists exactly once. */
  async checkBooks() {
    const events = await this.client.events(0);
    events.forEach((event, i) => assert.equal(event.seq, i + 1));
    const created = events.filter((e) => e.type === "job_order.created").map((e) => e.order);
    assert.equal(new Set(created).size, created.length);
    for (const order of this.orders) assert.ok(created.includes(order.id), `order ${order.id} is lost`);
  }

  async needsPerson() {
    return (await this.client.get("/api/v1/fleet")).needs_resume.includes(VEHICLE);
  }
}

/** Drives on one system, each interrupted a little later on its way. */
async function interrupted(t, points, die) {
  const drives = await Drives.begin();
  t.after(() => drives.system.stop());
  for (let i = 0; i < points; ++i) {
    await t.test(`point ${i + 1}`, async () => {
      const { order, number } = await drives.driveTo(i / (points - 1));
      await die(drives, order, i);
      await drives.checkEnded(order, number);
    });
  }
  await drives.checkBooks();
}

async function killServer(drives, order) {
  const { system, client } = drives;
  await system.kill(system.server);
  const stood = await drives.untilStanding();  // it may finish the base it was granted
  await system.startServer();
  await client.untilReady(VEHICLE);
  const { state } = await client.get(`/api/v1/job-orders/${order.id}`);
  if (state !== "Ended") {
    assert.equal(state, "Interrupted");
    await drives.checkStoodStill(stood);
    await drives.allowToMove();
  } else if (await drives.needsPerson()) {
    await drives.allowToMove();
  }
}

async function killAgent(drives, order, i) {
  const { system, client } = drives;
  await system.kill(system.agents.get(VEHICLE));
  const stood = drives.truth;
  system.startAgent(VEHICLE, { seed: 100 + i, sensing: "rendered" });
  await client.untilVehicle(VEHICLE, (v) => v.link === "live" && (v.pose_known || v.needs_resume), "is back");
  if ((await client.get(`/api/v1/job-orders/${order.id}`)).state === "Ended") return;
  await drives.checkStoodStill(stood);
  await client.untilOrder(order.id, (o) => o.state === "Interrupted" || o.state === "Ended", "is interrupted", 20);
  // Between stations no code is in view: the person measures with a tape and says where it stands.
  if (!(await client.get(`/api/v1/vehicles/${VEHICLE}`)).pose_known) {
    await until("the position is accepted", async () => {
      const { truth } = drives;
      const answer = await client.request("POST", `/api/v1/vehicles/${VEHICLE}/init-position`, { body: { x_m: truth.x_m + 0.005, y_m: truth.y_m - 0.005, heading_rad: truth.heading_rad + 0.0005, within_m: 0.01, within_rad: 0.002 } });
      return answer.status === 202;
    }, { timeout_s: 20, every_ms: 50 });
    await client.untilReady(VEHICLE);
  }
  if (await drives.needsPerson()) await drives.allowToMove();
}

describe("kill -9", { concurrency: true }, () => {
  test(`server killed at ${SERVER_POINTS} points`, (t) => interrupted(t, SERVER_POINTS, killServer));
  test(`agent killed at ${AGENT_POINTS} points`, (t) => interrupted(t, AGENT_POINTS, killAgent));
});
