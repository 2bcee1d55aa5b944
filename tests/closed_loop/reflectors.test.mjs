// Li 2022's measuring vehicle among reflectors: with no code in view it finds itself by them, and what it drives by them
// between codes ends where it should. Truth judges.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client, angleBetween } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";

const MM = 1e-3, DEG = Math.PI / 180;
const ID = "MV-01";
let system, client;

before(async () => {
  system = await System.create("measuring-hall");
  system.prepareVehicles([ID]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
});
after(() => system?.stop());

const vehicle = () => client.get(`/api/v1/vehicles/${ID}`);

test("with every code covered it finds itself by the reflectors around it", async () => {
  system.startAgent(ID, { seed: 31, sensing: "analytic", extra: ["--fault", "marker-lost"] });
  await client.untilReady(ID);
  const { pose, pose_basis, reflectors_in_view } = await vehicle();
  assert.equal(pose_basis.kind, "reflectors");
  assert.ok(reflectors_in_view >= 4, `${reflectors_in_view} in view`);
  const truth = system.lastTruth(ID);
  assert.ok(Math.hypot(pose.x_m - truth.x_m, pose.y_m - truth.y_m) <= 10 * MM, JSON.stringify({ pose, truth }));
  assert.ok(Math.abs(angleBetween(pose.heading_rad, truth.heading_rad)) <= 0.1 * DEG);
});

test("between codes it drives by reflectors, and arrives where it should before any adjusting", async () => {
  await system.kill(system.agents.get(ID));
  system.startAgent(ID, { seed: 31, extra: ["--drive", "servo"] });
  await client.untilReady(ID);
  const order = await client.order(ID, [2, 6, 4, 1]);
  const { state, reason } = await client.untilEnded(order.id, 150);
  assert.equal(state, "Ended", JSON.stringify(reason));
  const stops = await client.stops(order.id);
  assert.deepEqual(stops.map((stop) => [stop.number, stop.inside]), [2, 6, 4, 1].map((number) => [number, true]));
  for (const { number, arrival } of stops) {
    assert.ok(arrival, `station ${number} has no arrival`);
    assert.ok(Math.hypot(arrival.dx_m, arrival.dy_m) <= 15 * MM, `station ${number}: the drive ended ${arrival.dx_m / MM}, ${arrival.dy_m / MM} mm off`);
  }
});

test("with its scanner covered it says that it sees none, and goes on by codes", async () => {
  await system.kill(system.agents.get(ID));
  system.startAgent(ID, { seed: 31, sensing: "analytic", extra: ["--fault", "scanner-covered"] });
  await until("a pose by codes, and no reflector in view", async () => {
    const { pose_known, pose_basis, reflectors_in_view } = await vehicle();
    return pose_known && pose_basis.kind === "codes" && reflectors_in_view === 0;
  }, { timeout_s: 20 });
});
