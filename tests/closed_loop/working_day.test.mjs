// The working day of Tang's platform (2020, section 2, workflow a to c): driven by hand below the aircraft that hangs at station 0,
// it takes it over, brings it through stations 1 to 6, stands on its feet at each while people work, has its height adjusted by
// 50 mm, and sets it down at station 7. Real server, real program, machine and pictures over TCP. The person beside it sees where it truly is.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Client, angleBetween } from "../harness/client.mjs";
import { HandHeld } from "../harness/hand_held.mjs";
import { morning } from "../harness/plants.mjs";
import { System, until } from "../harness/processes.mjs";

const kId = "TP-01", kLoad = "A-101", kWeight_N = 18200 * 9.80665, MM = 1e-3, DEG = Math.PI / 180;
let system, client, socket;

before(async () => {
  system = await System.create(morning(0));
  system.prepareVehicles([kId]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  socket = join(system.directory, "hand.sock");
  await system.startOverTcp(kId, { seed: 22, timeFactor: 6, extra: ["--hand-held", socket] });
  await client.untilReady(kId);
});
after(() => system?.stop());

/** Where the vehicle has to go from where it is, as one sees it who walks beside it. */
function wayTo({ pose }) {
  const truth = system.lastTruth(kId), [dx, dy] = [pose.x_m - truth.x_m, pose.y_m - truth.y_m];
  const [c, s] = [Math.cos(truth.heading_rad), Math.sin(truth.heading_rad)];
  return { ahead_m: c * dx + s * dy, left_m: c * dy - s * dx, turn_rad: angleBetween(pose.heading_rad, truth.heading_rad) };
}

/** Presses one direction until the person sees it is as it has to be; slower at the end. */
async function byHand(control, name, left, near) {
  const kAxis = { ahead: "vx_mps", aside: "vy_mps", turn: "turn_radps" }, kMost = { ahead: 0.3, aside: 0.15, turn: 0.05 };
  await until(`is ${name} as it has to be`, async () => {
    const way = left();
    if (Math.abs(way) <= near) return true;
    const speed = Math.sign(way) * Math.min(kMost[name], Math.max(0.02 * (name === "turn" ? 0.3 : 1), 0.25 * Math.abs(way)));
    const answer = await control.send({ do: "drive", [kAxis[name]]: speed });
    assert.ok(answer.ok, JSON.stringify(answer));
    return false;
  }, { timeout_s: 90, every_ms: 15 });
  await until("it stands", async () => (await control.send({ do: "where" })).standing);
}

test("an empty platform is driven by hand below the aircraft that hangs at station 0", async () => {
  assert.equal((await client.get(`/api/v1/loads/${kLoad}`)).station, 0);
  await until("the control's socket", () => existsSync(socket));
  const control = await HandHeld.open(socket);
  assert.equal((await control.send({ do: "take" })).operating_mode, "MANUAL");
  await client.untilVehicle(kId, (v) => v.operating_mode === "MANUAL" && v.needs_resume, "is in a person's hands, everywhere");
  const there = system.plant.station(0);
  for (let round = 0; round < 4; ++round) {
    await byHand(control, "ahead", () => wayTo(there).ahead_m, 10 * MM);
    await byHand(control, "aside", () => wayTo(there).left_m, 10 * MM);
    await byHand(control, "turn", () => wayTo(there).turn_rad, 0.1 * DEG);
    const { ahead_m, left_m } = wayTo(there);
    if (Math.hypot(ahead_m, left_m) <= 20 * MM) break;
  }
  assert.equal((await control.send({ do: "give_back" })).operating_mode, "AUTOMATIC");
  control.close();
  await client.untilVehicle(kId, (v) => v.operating_mode === "AUTOMATIC" && v.at_station === there.id, "stands at station 0, its own again");
  await client.post("/api/v1/fleet/resume", { vehicles: [kId] });
  const order = await client.order(kId, [0]);
  assert.equal((await client.untilEnded(order.id)).state, "Ended");
  const stop = (await client.stops(order.id)).at(-1);
  assert.ok(stop.inside, JSON.stringify(stop));
  assert.equal(stop.load, undefined);
});

test("by one order it takes 18.2 t over, works at stations 1 to 6 on its feet, and sets it down at 7", async () => {
  const up = { type: "raiseParking" }, down = { type: "lowerParking" };
  const raised = { type: "setBracketHeight", parameters: { bracket: "all", height_m: 0.21 } };
  const pick = { type: "pick", parameters: { load: kLoad } };
  const order = await client.post("/api/v1/job-orders", {
    vehicle: kId,
    steps: [
      { station: 1, before: [pick], after: [down] },
      { station: 2, before: [up], after: [down] },
      { station: 3, before: [up], after: [down, raised] },
      { station: 4, before: [up], after: [down] },
      { station: 5, before: [up], after: [down] },
      { station: 6, before: [up], after: [down] },
      { station: 7, before: [up], after: [{ type: "drop" }] },
    ],
  });
  const carrying = await client.untilVehicle(kId, (v) => v.load === kLoad, "carries it", 90);
  const force_N = (vehicle) => vehicle.brackets.reduce((sum, b) => sum + b.force_a_n + b.force_b_n, 0);
  assert.ok(Math.abs(force_N(carrying) - kWeight_N) < 0.03 * kWeight_N, `${force_N(carrying)} N`);
  const before_m = carrying.brackets.map((b) => b.height_m);
  const parked = await client.untilVehicle(kId, (v) => v.at_station === "st03" && v.brackets.every((b) => b.height_m > 0.2095), "has its height adjusted at station 3", 240);
  assert.ok(parked.parking_feet.every((foot) => foot.force_n > 10_000), "on its feet");
  parked.brackets.forEach((b, i) => assert.ok(b.height_m - before_m[i] >= 50 * MM, `${b.name} from ${before_m[i]} m`));

  const ended = await client.untilEnded(order.id, 400);
  assert.equal(ended.state, "Ended", JSON.stringify(ended.reason));
  const stops = await client.stops(order.id);
  assert.ok(stops.every((stop) => stop.inside), JSON.stringify(stops));
  assert.deepEqual(stops.map((stop) => stop.number), [1, 2, 3, 4, 5, 6, 7]);
  const truth = system.truth(kId);
  for (const stop of stops) {
    assert.equal(stop.load, kLoad);
    const { pose } = system.plant.station(stop.number), measured_ms = Date.parse(stop.at);
    const stood = truth.findLast((line) => line.t_ms <= measured_ms);
    const off = { x: stood.x_m - pose.x_m, y: stood.y_m - pose.y_m };
    assert.ok(Math.hypot(stop.dx_m - off.x, stop.dy_m - off.y) <= 1 * MM, `at ${stop.number} the record says ${stop.dx_m / MM}, ${stop.dy_m / MM} mm; true is ${off.x / MM}, ${off.y / MM} mm`);
  }

  const empty = await client.get(`/api/v1/vehicles/${kId}`);
  assert.deepEqual([empty.load, empty.load_fault], [undefined, undefined]);
  assert.ok(force_N(empty) < 0.02 * kWeight_N, `${force_N(empty)} N are left`);
  const moved = (await client.events()).filter(({ type }) => type === "load.moved");
  assert.deepEqual(moved.map(({ params }) => params), [
    { load: kLoad, from_station: 0, to_vehicle: kId },
    { load: kLoad, from_vehicle: kId, to_station: 7 },
  ]);
  moved.forEach((event) => assert.equal(event.order, order.id));
});
