// Vehicles of one camera stop by rendered images of an AprilTag or a circular landmark. Truth comes from the simulated
// world's own log.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client, angleBetween } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";

const MM = 1e-3;
const DEG = Math.PI / 180;
const VEHICLES = { "MV-01": { kind: "AprilTag", stations: [13, 12] }, "DL-01": { kind: "landmark", stations: [32, 31] } };
let system, client;

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles([...Object.keys(VEHICLES), "OM-03"]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  for (const [i, id] of Object.keys(VEHICLES).entries()) system.startAgent(id, { seed: 21 + i });
  system.startAgent("OM-03", { seed: 23 });
  for (const id of [...Object.keys(VEHICLES), "OM-03"]) await client.untilReady(id);
});
after(() => system?.stop());

for (const [id, { kind, stations }] of Object.entries(VEHICLES)) {
  test(`${id} stops by the images of a ${kind}, measured and true`, async () => {
    const order = await client.order(id, stations);
    assert.equal((await client.untilEnded(order.id, 150)).state, "Ended");
    const inside = (await client.stops(order.id)).filter((stop) => stop.inside);
    assert.deepEqual(inside.map((stop) => stop.number), stations);
    const stop = inside.at(-1);
    assert.equal(stop.method, "single_camera");
    const { pose } = system.plant.station(stop.number);
    const truth = system.lastTruth(id);
    assert.ok(Math.hypot(stop.dx_m - (truth.x_m - pose.x_m), stop.dy_m - (truth.y_m - pose.y_m)) <= 1 * MM,
      `record says ${stop.dx_m / MM}, ${stop.dy_m / MM} mm; true is ${(truth.x_m - pose.x_m) / MM}, ${(truth.y_m - pose.y_m) / MM} mm`);
    assert.ok(Math.abs(angleBetween(stop.dheading_rad, angleBetween(truth.heading_rad, pose.heading_rad))) <= 0.1 * DEG);
  });
}

test("DL-01 comes round the hall by the codes that it passes: 250 m, and each stop is in view where the drive ends", async () => {
  // From station 34 it has to take the lanes; free floor has no codes.
  const order = await client.order("DL-01", [34, 37, 34]);
  assert.equal((await client.untilEnded(order.id, 120)).state, "Ended");
  const stops = (await client.stops(order.id)).filter((stop) => stop.attempt === 1).slice(1);
  assert.deepEqual(stops.map((stop) => stop.number), [37, 34]);
  for (const { number, arrival } of stops) {
    assert.ok(arrival, `station ${number}: its code was not in view where the drive ended`);
    assert.ok(Math.hypot(arrival.dx_m, arrival.dy_m) <= 20 * MM, `station ${number}: the drive ended ${arrival.dx_m / MM}, ${arrival.dy_m / MM} mm off`);
  }
  const { codes_under_way: codes, errors } = await client.get("/api/v1/vehicles/DL-01");
  assert.ok(codes.passed >= 5 && codes.read >= 0.9 * codes.passed, JSON.stringify(codes));
  assert.match(codes.last, /^\d+(, \d+)*$/);
  assert.deepEqual(errors.filter((error) => error.type === "codeRefused"), []);
});

test("MV-01 drives a free manoeuvre, planned beside the fleet, to a measured stop", async () => {
  const order = await client.order("MV-01", [{ station: 13, motion_mode: "free" }]);
  assert.equal((await client.untilEnded(order.id, 150)).state, "Ended");
  const inside = (await client.stops(order.id)).filter((stop) => stop.inside);
  assert.deepEqual(inside.map((stop) => [stop.number, stop.mode]), [[13, "free"]]);
});

test("OM-03 drives combined and oblique moves to measured stops", async () => {
  // Across and half round on the way; back across, and half round at the end.
  const modes = { 26: "combined", 30: "oblique" };
  const order = await client.order("OM-03", Object.entries(modes).map(([station, motion_mode]) => ({ station: Number(station), motion_mode })));
  assert.equal((await client.untilEnded(order.id, 150)).state, "Ended");
  const inside = (await client.stops(order.id)).filter((stop) => stop.inside);
  assert.deepEqual(inside.map((stop) => [stop.number, stop.mode]), Object.entries(modes).map(([station, mode]) => [Number(station), mode]));
});
