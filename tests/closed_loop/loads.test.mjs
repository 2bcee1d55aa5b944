// An aircraft as a thing (Tang 2020, section 2): the platform sets it down on the stands of station 7, drives away empty, comes
// back and takes it over again. Real server, real program, its machine and pictures over TCP; the load cells and the next stops tell what it carries.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";

const kId = "TP-01", kLoad = "A-101", kPath = `/api/v1/vehicles/${kId}`, kWeight_N = 18200 * 9.80665;
let system, client;

before(async () => {
  system = await System.create("pulse-line");
  system.prepareVehicles([kId]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  await system.startOverTcp(kId, { seed: 22, timeFactor: 6 });
  await client.untilReady(kId);
});
after(() => system?.stop());

const lifts = (body) => client.request("POST", `${kPath}/lifts`, { body });
const load = () => client.get(`/api/v1/loads/${kLoad}`);
const force_N = (vehicle) => vehicle.brackets.reduce((sum, b) => sum + b.force_a_n + b.force_b_n, 0);
const ended = () => client.untilVehicle(kId, (v) => v.lift && v.lift.state !== "under_way", "has moved its brackets", 90);
async function done(body) {
  const { status, body: answer } = await lifts(body);
  assert.equal(status, 202, JSON.stringify(answer));
  const vehicle = await ended();
  assert.equal(vehicle.lift.state, "done", vehicle.lift.why);
  return vehicle;
}
async function drive(...stations) {
  const order = await client.order(kId, stations);
  const last = await client.untilEnded(order.id, 180);
  assert.equal(last.state, "Ended", JSON.stringify(last.reason));
  const stop = (await client.stops(order.id)).at(-1);
  assert.ok(stop.inside, JSON.stringify(stop));
  return stop;
}

test("nobody sets it down where nothing holds it, nor with brackets lower than what would", async () => {
  assert.deepEqual([(await load()).vehicle, (await load()).station], [kId, undefined]);
  assert.equal((await lifts({ type: "drop" })).body.code, "no_support_here");
  assert.equal((await lifts({ type: "pick", load: kLoad })).body.code, "no_support_here");
  assert.equal((await lifts({ type: "pick" })).status, 400);
  assert.equal((await drive(7)).load, kLoad);
  assert.equal((await lifts({ type: "drop" })).body.code, "brackets_too_low");
});

test("it sets the aircraft down by small steps and drives away without it", async () => {
  await done({ type: "setBracketHeight", bracket: "all", height_m: 0.16 });
  const empty = await done({ type: "drop" });
  assert.ok(force_N(empty) < 0.02 * kWeight_N, `${force_N(empty)} N are left`);
  assert.ok(empty.brackets.every(({ height_m }) => height_m < 0.12), JSON.stringify(empty.brackets));
  assert.deepEqual([(await load()).station, (await load()).vehicle, empty.load, empty.load_name], [7, undefined, undefined, ""]);
  assert.equal((await client.get("/api/v1/stations/7")).load, kLoad);
  assert.equal((await lifts({ type: "drop" })).body.code, "vehicle_empty");
  await done({ type: "setBracketHeight", bracket: "all", height_m: 0 });
  assert.equal((await drive(6)).load, undefined);
});

test("it takes the aircraft over again, and the server knows it over its own restart", async () => {
  await drive(7);
  const { events } = await pickAndSee();
  assert.deepEqual(events.map(({ params }) => params), [
    { load: kLoad, from_vehicle: kId, to_station: 7 },
    { load: kLoad, from_station: 7, to_vehicle: kId },
  ]);
  await system.kill(system.server);
  await system.startServer();
  await client.untilReady(kId);
  assert.equal((await load()).vehicle, kId);
  await client.post("/api/v1/fleet/resume", { vehicles: [kId] });
  assert.equal((await drive(6)).load, kLoad);
});

async function pickAndSee() {
  const loaded = await done({ type: "pick", load: kLoad });
  assert.ok(Math.abs(force_N(loaded) - kWeight_N) < 0.03 * kWeight_N, `${force_N(loaded)} N`);
  assert.equal(loaded.load, kLoad);
  assert.equal((await client.get("/api/v1/stations/7")).load, undefined);
  return { events: (await client.events()).filter(({ type }) => type === "load.moved") };
}
