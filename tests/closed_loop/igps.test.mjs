// Wang's platform in the iGPS cell: no camera, no code. It finds itself, steers and stops by the light of the transmitters
// alone; truth judges. When transmitters fail it goes on with the others, and with one it says what it lacks.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client, angleBetween } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";

const MM = 1e-3, DEG = Math.PI / 180;
const ID = "OM-01";
let system, client;

before(async () => {
  system = await System.create("igps-cell");
  assert.deepEqual(system.plant.model.vehicle_types.map((type) => type.cameras.length), [0], "the cell has no camera");
  assert.deepEqual(system.plant.model.markers, [], "nor a code");
  system.prepareVehicles([ID]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
});
after(() => system?.stop());

async function stopsOf(stations) {
  const order = await client.order(ID, stations);
  const { state, reason } = await client.untilEnded(order.id, 150);
  assert.equal(state, "Ended", JSON.stringify(reason));
  return client.stops(order.id);
}

function judge(stop) {
  const { pose } = system.plant.station(stop.number);
  const truth = system.lastTruth(ID);
  const off = { x: stop.dx_m - (truth.x_m - pose.x_m), y: stop.dy_m - (truth.y_m - pose.y_m) };
  assert.ok(Math.hypot(off.x, off.y) <= 0.5 * MM, `station ${stop.number}: the record is ${off.x / MM}, ${off.y / MM} mm from the truth`);
  assert.ok(Math.hypot(off.x, off.y) <= 5 * stop.sigma_xy_m, `station ${stop.number}: ${Math.hypot(off.x, off.y) / stop.sigma_xy_m} sigmas`);
  assert.ok(Math.abs(angleBetween(stop.dheading_rad, angleBetween(truth.heading_rad, pose.heading_rad))) <= 0.02 * DEG);
}

test("it is told nothing and finds itself, then drives and stops by light", async () => {
  system.startAgent(ID, { seed: 31 });
  await client.untilReady(ID);
  assert.equal((await client.get(`/api/v1/vehicles/${ID}`)).pose_basis.kind, "receivers");
  const stops = await stopsOf([2, 6, 4, 1]);
  assert.deepEqual(stops.map((stop) => [stop.number, stop.inside, stop.method]), [2, 6, 4, 1].map((number) => [number, true, "igps"]));
  for (const stop of stops) assert.ok(stop.markers.length >= 2 && stop.markers.every((name) => name.startsWith("tx-")), stop.markers.join());
  judge(stops.at(-1));
  // Corrected on the way, it arrives where it should before any adjusting.
  for (const { number, arrival } of stops.slice(1)) {
    assert.ok(arrival, `station ${number} has no arrival`);
    assert.ok(Math.hypot(arrival.dx_m, arrival.dy_m) <= 5 * MM, `station ${number}: the drive ended ${arrival.dx_m / MM}, ${arrival.dy_m / MM} mm off`);
  }
});

test("its path solution takes what each way asks for: an arc, an oblique way, or driving and turning at once", async () => {
  for (const [number, mode] of [[5, "fixed_axis_rotation"], [4, "oblique"], [2, "combined"]]) {
    await stopsOf([1]);
    const stop = (await stopsOf([number])).at(-1);
    assert.deepEqual([stop.number, stop.mode, stop.inside], [number, mode, true]);
    judge(stop);
  }
});

test("with four of six transmitters dark it goes on by two, and knows its place less well", async () => {
  await system.kill(system.agents.get(ID));
  system.startAgent(ID, { seed: 31, extra: ["tx-1", "tx-2", "tx-3", "tx-4"].flatMap((name) => ["--fault", `transmitter-dark=${name}`]) });
  await client.untilReady(ID);
  const [stop] = await stopsOf([2]);
  assert.ok(stop.inside && stop.method === "igps", JSON.stringify(stop));
  assert.deepEqual(stop.markers, ["tx-5", "tx-6"]);
  judge(stop);
});

test("with one transmitter left it says what it lacks, and nobody is told a place", async () => {
  await system.kill(system.agents.get(ID));
  system.startAgent(ID, { seed: 31, extra: ["tx-1", "tx-2", "tx-3", "tx-4", "tx-5"].flatMap((name) => ["--fault", `transmitter-dark=${name}`]) });
  const vehicle = await until("the vehicle to say why", async () => {
    const seen = await client.get(`/api/v1/vehicles/${ID}`);
    return seen.errors.some((error) => error.type === "lightLost") && seen;
  }, { timeout_s: 30 });
  assert.equal(vehicle.pose_known, false);
  assert.match(vehicle.errors.find((error) => error.type === "lightLost").description, /two are needed/);
});
