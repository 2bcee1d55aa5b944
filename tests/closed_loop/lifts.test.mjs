// Brackets and parking feet outside an order (Tang 2020, section 2, workflow b): the platform stands on its feet with 18.2 t
// on it, and people adjust the aircraft's height. Real server, real program, its machine over TCP; the vehicle's own sensors tell heights and forces.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";

const kId = "TP-01", kPath = `/api/v1/vehicles/${kId}`, kWeight_N = 18200 * 9.80665;
let system, client;

before(async () => {
  system = await System.create("pulse-line");
  system.prepareVehicles([kId]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  await system.startOverTcp(kId, { seed: 22, timeFactor: 3 });
  await client.untilReady(kId);
});
after(() => system?.stop());

const move = (body) => client.post(`${kPath}/lifts`, body);
const brackets = (height_m, bracket = "all") => move({ type: "setBracketHeight", bracket, height_m });
const ended = (timeout_s = 60) => client.untilVehicle(kId, (v) => v.lift && v.lift.state !== "under_way", "has moved its brackets or feet", timeout_s);
const done = async () => {
  const vehicle = await ended();
  assert.equal(vehicle.lift.state, "done", vehicle.lift.why);
  return vehicle;
};
const heights = (vehicle) => vehicle.brackets.map((b) => b.height_m);
const assertHeights = (vehicle, height_m) => heights(vehicle).forEach((h) => assert.ok(Math.abs(h - height_m) < 0.001, `${h} m instead of ${height_m} m`));
const force_N = (vehicle) => vehicle.brackets.reduce((sum, b) => sum + b.force_a_n + b.force_b_n, 0);
/** A vehicle's state after the next: what moves is elsewhere then. */
const later = async () => {
  const { last_heard_at: first } = await client.get(kPath);
  const next = await client.untilVehicle(kId, (v) => v.last_heard_at !== first, "is heard again");
  return client.untilVehicle(kId, (v) => v.last_heard_at !== next.last_heard_at, "is heard again");
};
const assertHeld = async () => {
  const before = heights(await client.get(kPath)), after = heights(await later());
  assert.deepEqual(after, before);
  return after[0];
};
const refusal = async (body) => {
  const answer = await client.request("POST", `${kPath}/lifts`, { body });
  assert.ok(answer.status >= 400, `it was taken: ${JSON.stringify(answer.body.lift)}`);
  return { status: answer.status, ...answer.body };
};

test("parked on its feet the aircraft is raised by 50 mm; no order starts until all is as it has to be", async () => {
  await move({ type: "lowerParking" });
  const parked = await done();
  assert.ok(parked.parking_feet.every((foot) => foot.force_n > 10_000), JSON.stringify(parked.parking_feet));

  await move({ type: "raiseParking", foot: "back left" }); // it carries a quarter of 28 t
  assert.match((await ended()).lift.why, /^foot_carries: foot back left, force_n /);

  const { lift } = await brackets(0.05);
  assert.equal(lift.state, "under_way");
  assert.equal(lift.height_m, 0.05);
  const order = await client.order(kId, [1]);
  await client.untilOrder(order.id, (o) => o.reason?.code === "lifts_moving", "waits for the brackets");
  const raised = await done();
  assertHeights(raised, 0.05);
  assert.ok(Math.abs(force_N(raised) / kWeight_N - 1) < 0.02, `${force_N(raised)} N`);

  await client.untilOrder(order.id, (o) => o.reason?.code === "parking_feet_down", "waits for the feet");
  await move({ type: "raiseParking" });
  await done();
  assert.equal((await client.untilEnded(order.id)).state, "Ended");
  await brackets(0);
  assertHeights(await done(), 0);
});

test("two people: the second is told by whom they move, and anybody holds them where they are", async () => {
  await brackets(0.2);
  const second = await refusal({ type: "lowerParking" });
  assert.equal(second.status, 409);
  assert.equal(second.code, "lifts_moving");
  await client.untilVehicle(kId, (v) => heights(v)[0] > 0.01, "has begun");
  await client.post(`${kPath}/lifts/stop`);
  await client.post(`${kPath}/lifts/stop`); // a frightened finger
  const held = await ended();
  assert.equal(held.lift.why, "lifts_stopped");
  const at_m = await assertHeld();
  assert.ok(at_m > 0.01 && at_m < 0.19, `${at_m} m`);
  await brackets(0);
  await done();
});

test("what cannot be is refused with its field, and nothing has moved", async () => {
  for (const [body, status, code, field] of [
    [{ type: "setBracketHeight", bracket: "middle", height_m: 0.1 }, 422, "unknown_bracket", "/bracket"],
    [{ type: "setBracketHeight", bracket: "all", height_m: 0.4 }, 422, "out_of_stroke", "/height_m"],
    [{ type: "setBracketHeight", bracket: "all", height_m: -0.1 }, 400, undefined, "/height_m"],
    [{ type: "setBracketHeight", bracket: "all" }, 400, undefined, "/height_m"],
    [{ type: "setBracketHeight", bracket: "all", height_m: 0.1, speed_mps: 0.02 }, 422, "out_of_speed", "/speed_mps"],
    [{ type: "setBracketHeight", bracket: "all", height_m: 0.1, speed_mps: 0 }, 400, undefined, "/speed_mps"],
    [{ type: "raiseParking", foot: "middle" }, 422, "unknown_foot", "/foot"],
    [{ type: "fly" }, 400, undefined, "/type"],
    [{ type: "lowerParking", height_m: 1 }, 400, undefined, "/height_m"],
  ]) {
    const answer = await refusal(body);
    assert.equal(answer.status, status, JSON.stringify(answer));
    if (code) assert.equal(answer.code, code);
    assert.ok(JSON.stringify(answer).includes(`"${field}"`), JSON.stringify(answer));
  }
  assertHeights(await client.get(kPath), 0);
});

test("one bracket that takes too much of the load stops by itself; all together move only when it is back", async () => {
  await brackets(0.25, "front left");
  const leaning = await ended();
  assert.match(leaning.lift.why, /^bracket_force_out_of_range: bracket /);
  assert.ok(leaning.load_fault, "the load breaks a rule of its type");
  const refused = await refusal({ type: "setBracketHeight", bracket: "all", height_m: 0.1 });
  assert.equal(refused.code, leaning.load_fault.code);
  await brackets(0, "front left");
  const back = await done();
  assert.equal(back.load_fault, undefined);
});

test("a foot alone, and brackets at a speed of one's own", async () => {
  await move({ type: "lowerParking", foot: "front left" });
  const one = await done();
  assert.deepEqual(one.parking_feet.filter((foot) => foot.extension_m > 0.002).map((foot) => foot.name), ["front left"]);
  assert.equal(one.lift.foot, "front left");
  await move({ type: "raiseParking", foot: "front left" });
  assert.ok((await done()).parking_feet.every((foot) => foot.extension_m === 0));

  const begun_ms = Date.now();
  await move({ type: "setBracketHeight", bracket: "all", height_m: 0.03, speed_mps: 0.005 });
  assertHeights(await done(), 0.03);
  assert.ok(Date.now() - begun_ms >= 2000, "0.03 m at 0.005 m/s, three times as fast"); // two seconds of ours
  await brackets(0);
  await done();
});

test("a pause in the middle holds them, and they go on by a person only", async () => {
  await brackets(0.2);
  await client.untilVehicle(kId, (v) => heights(v)[0] > 0.01, "has begun");
  await client.post(`${kPath}/pause`);
  assert.equal((await ended()).lift.why, "vehicle_paused");
  const held_m = await assertHeld();
  assert.equal((await refusal({ type: "lowerParking" })).code, "vehicle_paused");
  await client.post("/api/v1/fleet/resume", { vehicles: [kId] });
  await client.untilVehicle(kId, (v) => !v.paused && !v.pause_confirmed, "may move again");
  assert.equal(await assertHeld(), held_m);
  await brackets(0);
  await done();
});

test("the server dies in the middle of a lift: the vehicle holds it, and goes on only by a person", async () => {
  await brackets(0.25);
  await client.untilVehicle(kId, (v) => heights(v)[0] > 0.01, "has begun");
  await system.kill(system.server);
  await system.startServer();
  await client.untilVehicle(kId, (v) => v.link === "live" && v.last_heard_at && v.brackets.length > 0, "is heard again");
  const held_m = await assertHeld();
  assert.ok(held_m > 0.01 && held_m < 0.24, `${held_m} m`);
  const { needs_resume: needsResume } = await client.get(kPath);
  if (needsResume) await client.post("/api/v1/fleet/resume", { vehicles: [kId] });
  await until("it is taken again", async () => (await client.request("POST", `${kPath}/lifts`, { body: { type: "setBracketHeight", bracket: "all", height_m: 0.25 } })).status === 202);
  assertHeights(await done(), 0.25);
});
