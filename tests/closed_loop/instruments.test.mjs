// The laser tracker of the measuring hall is set down where it measures and picked up again (Li 2022, Fig. 1) by the brackets that carry
// aircraft elsewhere: a lifting table on three points. Real server, real program with rendered pictures; the stops and the load cells tell what it carries.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";

const kId = "MV-01", kTracker = "LT-1", kMass_kg = 60, MM = 1e-3;
let system, client;

before(async () => {
  system = await System.create("measuring-hall");
  system.prepareVehicles([kId]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  system.startAgent(kId, { seed: 9, timeFactor: 6 });
  await client.untilReady(kId);
});
after(() => system?.stop());

const load = () => client.get(`/api/v1/loads/${kTracker}`);
const felt_kg = (vehicle) => vehicle.brackets.reduce((sum, b) => sum + b.force_a_n + b.force_b_n, 0) / 9.80665;
const pick = { type: "pick", parameters: { load: kTracker } }, drop = { type: "drop" };

/** Its order to bring the tracker from one station to another, and to leave without it. */
async function bring(from, to, away) {
  const order = await client.order(kId, [{ station: from, after: [pick] }, { station: to, after: [drop] }, { station: away }]);
  const carrying = await client.untilVehicle(kId, (v) => v.load === kTracker, "carries it", 120);
  assert.ok(Math.abs(felt_kg(carrying) - kMass_kg) < 0.05 * kMass_kg, `${felt_kg(carrying)} kg`);
  const ended = await client.untilEnded(order.id, 240);
  assert.equal(ended.state, "Ended", JSON.stringify(ended.reason));
  const stops = await client.stops(order.id);
  assert.deepEqual(stops.map(({ number, load: carried, inside }) => [number, carried, inside]), [[from, undefined, true], [to, kTracker, true], [away, undefined, true]]);
  const { pose } = system.plant.station(away), { x_m, y_m } = system.lastTruth(kId), last = stops.at(-1);
  assert.ok(Math.hypot(last.dx_m - (x_m - pose.x_m), last.dy_m - (y_m - pose.y_m)) <= 1 * MM, JSON.stringify(last));
  const empty = await client.get(`/api/v1/vehicles/${kId}`);
  assert.deepEqual([empty.load, empty.load_fault, (await load()).station], [undefined, undefined, to]);
  assert.ok(felt_kg(empty) < 0.02 * kMass_kg, `${felt_kg(empty)} kg are left`);
}

test("a laser tracker is picked up where it stands and set down where it is to measure", () => bring(2, 5, 1));

test("it is brought back the same way, and its history says each move", async () => {
  await bring(5, 2, 4);
  const { items } = await client.get(`/api/v1/loads/${kTracker}/moves`);
  assert.deepEqual(items.map(({ from, to }) => [from, to]), [
    [{ vehicle: kId }, { station: 2 }], [{ station: 5 }, { vehicle: kId }], [{ vehicle: kId }, { station: 5 }], [{ station: 2 }, { vehicle: kId }],
  ]);
});
