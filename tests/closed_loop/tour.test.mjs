// The main job over REST with a real program that drives its machine over TCP: the platform drives Tang's Table 4 tour, and each stop is
// measured and true. Truth comes from the simulated world's own log, never over the link.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client, angleBetween } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";

const MM = 1e-3;
const DEG = Math.PI / 180;
let system, client;

before(async () => {
  system = await System.create("pulse-line");
  system.prepareVehicles(["TP-01"]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  await system.startOverTcp("TP-01", { seed: 7, timeFactor: 6 });
  await client.untilReady("TP-01");
});
after(() => system?.stop());

/** The vehicle's true stop against the drawing, and the record against the truth. */
function checkStop(stop) {
  const { pose } = system.plant.station(stop.number);
  const truth = system.lastTruth("TP-01");
  const off = { x: truth.x_m - pose.x_m, y: truth.y_m - pose.y_m, heading: angleBetween(truth.heading_rad, pose.heading_rad) };
  assert.ok(Math.abs(off.x) <= 25 * MM && Math.abs(off.y) <= 25 * MM, `true position off by ${off.x / MM}, ${off.y / MM} mm`);
  assert.ok(Math.abs(off.heading) <= 0.2 * DEG, `true heading off by ${off.heading / DEG} deg`);
  assert.ok(stop.inside, `stop ${JSON.stringify(stop)} is not inside`);
  assert.ok(Math.hypot(stop.dx_m - off.x, stop.dy_m - off.y) <= 1 * MM, `record says ${stop.dx_m / MM}, ${stop.dy_m / MM} mm; true is ${off.x / MM}, ${off.y / MM} mm`);
  assert.ok(Math.abs(angleBetween(stop.dheading_rad, off.heading)) <= 0.01 * DEG);
}

test("linear from station 1 to 2 is measured and true", async () => {
  const order = await client.order("TP-01", [{ station: 2, motion_mode: "linear" }]);
  assert.equal((await client.untilEnded(order.id)).state, "Ended");
  const stops = await client.stops(order.id);
  assert.equal(stops.at(-1).mode, "linear");
  assert.equal(stops.at(-1).method, "dual_camera");
  checkStop(stops.at(-1));
});

test("fixed-axis rotation from station 3 to 4 is measured and true", async () => {
  const there = await client.order("TP-01", [3]);
  assert.equal((await client.untilEnded(there.id)).state, "Ended");
  const order = await client.order("TP-01", [{ station: 4, motion_mode: "fixed_axis_rotation" }]);
  assert.equal((await client.untilEnded(order.id)).state, "Ended");
  const stops = await client.stops(order.id);
  assert.equal(stops.at(-1).mode, "fixed_axis_rotation");
  checkStop(stops.at(-1));
});

test("the whole Table 4 tour 1..7 in one order", async () => {
  const back = await client.order("TP-01", [1]);
  assert.equal((await client.untilEnded(back.id)).state, "Ended");
  const modes = { 2: "linear", 3: "linear", 4: "fixed_axis_rotation", 5: "fixed_axis_rotation", 6: "fixed_axis_rotation", 7: "linear" };
  const steps = Object.entries(modes).map(([station, motion_mode]) => ({ station: Number(station), motion_mode }));
  const order = await client.order("TP-01", steps);
  const ended = await client.untilEnded(order.id, 150);
  assert.equal(ended.state, "Ended");
  assert.deepEqual(ended.steps.map((s) => s.state), steps.map(() => "done"));
  const stops = (await client.stops(order.id)).filter((s) => s.inside);
  assert.deepEqual(stops.map((s) => s.number), [2, 3, 4, 5, 6, 7]);
  checkStop(stops.at(-1));
});
