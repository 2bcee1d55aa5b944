// A vehicle's program without any simulated world: it drives the platform through a controller over TCP, steers by the pictures
// that it asks for, and lifts. The controller's own log judges. When the controller dies, the vehicle stops and waits for a person.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client, angleBetween } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";

const kId = "TP-01", kPath = `/api/v1/vehicles/${kId}`;
let system, client, machine;

before(async () => {
  system = await System.create("pulse-line");
  system.prepareVehicles([kId]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  machine = await system.startOverTcp(kId, { seed: 7, timeFactor: 5 });
  await client.untilReady(kId);
});
after(() => system?.stop());

const truth = () => system.lastTruth(kId);

test("it drives to three stations and stands where its stops say", async () => {
  const order = await client.order(kId, [2, 3, 4]);
  assert.equal((await client.untilEnded(order.id, 180)).state, "Ended");
  const stops = await client.stops(order.id);
  assert.equal(stops.length >= 3, true, JSON.stringify(stops));
  for (const stop of stops.filter((s) => s.number !== 4 || s === stops.at(-1))) assert.ok(stop.method === "dual_camera", JSON.stringify(stop));
  const last = stops.at(-1), { pose } = system.plant.station(4), { x_m, y_m, heading_rad } = truth();
  assert.ok(last.inside, JSON.stringify(last));
  assert.ok(Math.hypot(last.dx_m - (x_m - pose.x_m), last.dy_m - (y_m - pose.y_m)) < 1e-3, `${JSON.stringify(last)} at ${x_m}, ${y_m}`);
  assert.ok(Math.abs(angleBetween(last.dheading_rad, heading_rad - pose.heading_rad)) < 2e-4);
});

test("it lifts what hangs on the controller, and the states tell its load cells", async () => {
  await client.post(`${kPath}/lifts`, { type: "setBracketHeight", bracket: "all", height_m: 0.03 });
  const raised = await client.untilVehicle(kId, (v) => v.lift?.state === "done" || v.lift?.state === "failed", "has lifted", 60);
  assert.equal(raised.lift.state, "done", raised.lift.why);
  raised.brackets.forEach((b) => assert.ok(Math.abs(b.height_m - 0.03) < 0.001, JSON.stringify(b)));
  await client.post(`${kPath}/lifts`, { type: "setBracketHeight", bracket: "all", height_m: 0 });
  await client.untilVehicle(kId, (v) => v.lift.state === "done" && v.brackets.every((b) => b.height_m < 0.001), "is down again", 60);
});

test("its controller dies on the way: it stands, says so, and goes on only by a person when it is back", async () => {
  const order = await client.order(kId, [1]);
  await until("it drives", () => truth().moving, { timeout_s: 60 });
  await system.kill(machine);
  const silent = await client.untilVehicle(kId, (v) => v.errors.some((e) => e.type === "machineSilent"), "says that its machine is silent");
  assert.ok(silent.errors.find((e) => e.type === "machineSilent").fatal);
  machine = await system.startMachine(kId, { seed: 7, port: machine.port });
  const where = () => { const { x_m, y_m, heading_rad } = truth(); return { x_m, y_m, heading_rad }; };
  const stands = where();
  await until("its line is taken up", () => system.log(`agent-${kId}`).includes("machine.reached"), { timeout_s: 20 });
  for (let i = 0; i < 10; ++i) await client.get(kPath);
  assert.deepEqual(where(), stands, "nothing moves by itself");
  await client.post("/api/v1/fleet/resume", { vehicles: [kId] });
  assert.equal((await client.untilEnded(order.id, 180)).state, "Ended");
});
