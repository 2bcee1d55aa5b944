// The main job over REST with real agents: the platform drives Tang's Table 4 tour, and each stop is
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
  system.startAgent("TP-01", { seed: 7 });
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

test("what each drive missed its station by is kept, was true, and the next preview is learned from it", async () => {
  const stops = (await client.get("/api/v1/stop-records?vehicle=TP-01&limit=100")).items.filter((s) => s.attempt === 1 && s.arrival);
  assert.ok(stops.length >= 8, `only ${stops.length} stops tell where their drive had ended`);
  const truth = system.truth("TP-01");
  let adjusted = 0;
  for (const stop of stops) {
    const { pose } = system.plant.station(stop.number);
    const x = pose.x_m + stop.arrival.dx_m, y = pose.y_m + stop.arrival.dy_m;
    const ended = truth.find((row) => row.order_id === stop.leg && !row.moving && row.last_node_seq === row.base_end_seq && Math.hypot(row.x_m - pose.x_m, row.y_m - pose.y_m) < 0.2);
    assert.ok(ended, `the truth of the drive to ${stop.number} is there`);
    const off = Math.hypot(ended.x_m - x, ended.y_m - y);
    assert.ok(off <= 1.5 * MM, `the drive to ${stop.number} ended ${off / MM} mm beside where the record says`);
    if (Math.hypot(stop.arrival.dx_m - stop.dx_m, stop.arrival.dy_m - stop.dy_m) > 0.5 * MM) ++adjusted;
  }
  assert.ok(adjusted >= 3, `only ${adjusted} of ${stops.length} stops were adjusted by more than 0.5 mm`);
  const taught = stops.filter((s) => s.mode === "linear" && s.arrival.expected_m > 0);
  assert.ok(taught.length >= 3, `${taught.length} linear drives began at a measured stop`);
  const preview = await client.post("/api/v1/job-orders?dryRun=true", { vehicle: "TP-01", steps: [{ station: 3, motion_mode: "linear" }] });
  const { expected_deviation } = preview.steps[0].options.find((option) => option.mode === "linear");
  assert.equal(expected_deviation.arrivals, Math.min(20, taught.length));
  assert.ok(expected_deviation.position_m > 0.1 * MM && expected_deviation.position_m < 60 * MM, JSON.stringify(expected_deviation));
});
