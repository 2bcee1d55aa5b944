// kill -9 of server and of agent at 20 points of a drive each: no acknowledged order is lost or doubled,
// nothing moves past its released base until a person allows it, and after that the drive ends.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";

const POINTS = Number(process.env.PULSELINE_KILL_POINTS ?? 20);
const VEHICLE = "TP-01";
// A body brakes within what it was released; rounding of poses in the log aside.
const PAST_BASE_M = 0.05;
let system, client;

before(async () => {
  system = await System.create("pulse-line");
  system.prepareVehicles([VEHICLE]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  system.startAgent(VEHICLE, { seed: 3, sensing: "rendered" });
  await client.untilReady(VEHICLE);
});
after(() => system?.stop());

/** The person of design.md section 4: looks at the vehicle, then allows it to move. */
async function allowToMove() {
  await client.untilVehicle(VEHICLE, (v) => v.link === "live", "is heard");
  await until("the resume is accepted", async () => {
    const answer = await client.request("POST", "/api/v1/fleet/resume", { body: { vehicles: [VEHICLE] } });
    return answer.status === 202;
  }, { timeout_s: 20, every_ms: 100 });
}

/** Where the vehicle stands for good: its truth log has not moved for a while of its own clock. */
async function untilStanding() {
  let last, since = 0;
  return until("the vehicle stands", () => {
    const truth = system.lastTruth(VEHICLE);
    const same = last && truth.x_m === last.x_m && truth.y_m === last.y_m && truth.heading_rad === last.heading_rad;
    if (!same) { last = truth; since = Date.now(); }
    return truth && !truth.moving && Date.now() - since > 400 && truth;
  }, { timeout_s: 30, every_ms: 50 });
}

const stationOf = () => system.lastTruth(VEHICLE);
let at = 1;
function nextStation() {
  at = at === 1 ? 2 : 1;
  return at;
}

/** Starts a drive and waits until it has gone `share` of its way. */
async function driveTo(share) {
  const number = nextStation();
  const begin = stationOf();
  const { pose } = system.plant.station(number);
  const whole = Math.hypot(pose.x_m - begin.x_m, pose.y_m - begin.y_m);
  const order = await client.order(VEHICLE, [{ station: number, motion_mode: "linear" }], { "Idempotency-Key": `kill-${number}-${Date.now()}` });
  await until(`the drive is at ${share}`, () => {
    const truth = system.lastTruth(VEHICLE);
    return Math.hypot(truth.x_m - begin.x_m, truth.y_m - begin.y_m) >= share * whole || Math.hypot(truth.x_m - pose.x_m, truth.y_m - pose.y_m) < 0.02;
  }, { timeout_s: 40, every_ms: 5 });
  return { order, number, begin, whole };
}

async function checkEnded(order, number) {
  const ended = await client.untilEnded(order.id, 60);
  assert.equal(ended.state, "Ended", JSON.stringify(ended));
  const inside = (await client.stops(order.id)).filter((s) => s.inside);
  assert.equal(inside.length, 1, "one good stop, neither lost nor doubled");
  assert.equal(inside[0].number, number);
}

/** Events are gapless and every order of this test exists exactly once. */
async function checkBooks(orders) {
  const events = await client.events(0);
  events.forEach((event, i) => assert.equal(event.seq, i + 1));
  const created = events.filter((e) => e.type === "job_order.created").map((e) => e.order);
  assert.equal(new Set(created).size, created.length);
  for (const order of orders) assert.ok(created.includes(order.id), `order ${order.id} is lost`);
}

test(`server killed at ${POINTS} points`, async (t) => {
  const orders = [];
  for (let i = 0; i < POINTS; ++i) {
    await t.test(`point ${i + 1}`, async () => {
      const { order, number } = await driveTo(i / (POINTS - 1));
      orders.push(order);
      await system.kill(system.server);
      const stood = await untilStanding();  // it may finish the base it was granted
      await system.startServer();
      await client.untilReady(VEHICLE);
      const before = await client.get(`/api/v1/job-orders/${order.id}`);
      if (before.state !== "Ended") {
        assert.equal(before.state, "Interrupted", JSON.stringify(before));
        const later = await untilStanding();
        assert.ok(Math.hypot(later.x_m - stood.x_m, later.y_m - stood.y_m) <= PAST_BASE_M, "it moved without a person's act");
        await allowToMove();
      } else if ((await client.get("/api/v1/fleet")).needs_resume.includes(VEHICLE)) {
        await allowToMove();
      }
      await checkEnded(order, number);
    });
  }
  await checkBooks(orders);
});

test(`agent killed at ${POINTS} points`, async (t) => {
  const orders = [];
  for (let i = 0; i < POINTS; ++i) {
    await t.test(`point ${i + 1}`, async () => {
      const { order, number } = await driveTo(i / (POINTS - 1));
      orders.push(order);
      const agent = system.agents.get(VEHICLE);
      await system.kill(agent);
      const stood = system.lastTruth(VEHICLE);
      system.startAgent(VEHICLE, { seed: 100 + i, sensing: "rendered" });
      const vehicle = await client.untilVehicle(VEHICLE, (v) => v.link === "live" && (v.pose_known || v.needs_resume), "is back");
      const state = await client.get(`/api/v1/job-orders/${order.id}`);
      if (state.state !== "Ended") {
        const later = await untilStanding();
        assert.ok(Math.hypot(later.x_m - stood.x_m, later.y_m - stood.y_m) <= PAST_BASE_M, "it moved without a person's act");
        await client.untilOrder(order.id, (o) => o.state === "Interrupted" || o.state === "Ended", "is interrupted", 20);
        // Between stations no code is in view: the person measures with a tape and says where it stands.
        const now = await client.get(`/api/v1/vehicles/${VEHICLE}`);
        if (!now.pose_known) {
          await until("the position is accepted", async () => {
            const truth = system.lastTruth(VEHICLE);
            const answer = await client.request("POST", `/api/v1/vehicles/${VEHICLE}/init-position`, { body: { x_m: truth.x_m + 0.005, y_m: truth.y_m - 0.005, heading_rad: truth.heading_rad + 0.0005 } });
            return answer.status === 202;
          }, { timeout_s: 20, every_ms: 200 });
          await client.untilReady(VEHICLE);
        }
        if ((await client.get("/api/v1/fleet")).needs_resume.includes(VEHICLE)) await allowToMove();
      }
      assert.ok(vehicle);
      await checkEnded(order, number);
    });
  }
  await checkBooks(orders);
});
