// What befalls a vehicle on its way: it stops safely, says why, and goes on or is refused as the contract says. And the
// hand-held control: in a person's hands it is out of the server's, and given back nothing moves by itself.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { HandHeld } from "../harness/hand_held.mjs";
import { System, until } from "../harness/processes.mjs";

let system, client;

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles(["DL-01", "DL-02", "DL-03", "MV-01", "TP-01", "OM-01"]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
});
after(() => system?.stop());

const start = async (id, extra, seed = 5) => {
  system.startAgent(id, { seed, extra });
  await client.untilReady(id);
};
const moves = (id) => system.lastTruth(id)?.moving === true;
/** The vehicle stands, by the truth log, and stays where it is while the server is asked a few times. */
const standsStill = async (id) => {
  await until(`${id} stands`, () => !moves(id));
  const { x_m, y_m } = system.lastTruth(id);
  for (let i = 0; i < 5; ++i) await client.get(`/api/v1/vehicles/${id}`);
  assert.deepEqual([system.lastTruth(id).x_m, system.lastTruth(id).y_m], [x_m, y_m]);
};

test("something in the way: it waits before it, says so, and goes on when the way is free", async () => {
  // From station 34 to 35, 10 m on the same lane: a box stands in the middle from the beginning.
  await start("DL-01", ["--fault", "obstacle=97,46@0", "--fault", "way-free@9"]);
  const order = await client.order("DL-01", [35]);
  const blocked = await client.untilVehicle("DL-01", (v) => v.activity === "blocked", "is blocked");
  assert.ok(blocked.field_violation);
  assert.equal(blocked.reason.code, "field_violation");
  assert.ok(blocked.errors.some((error) => error.type === "obstacle"), JSON.stringify(blocked.errors));
  await until("it stands", () => !moves("DL-01"));
  const { x_m } = system.lastTruth("DL-01");
  assert.ok(Math.abs(x_m - 97) > 0.25 + 0.5, `it stands at ${x_m}, the box at 97`);
  assert.equal((await client.untilEnded(order.id)).state, "Ended");
});

test("its scanners' windows covered on the way: it stops, names what it lacks, and goes on when they are clean", async () => {
  await start("DL-03", ["--fault", "look-out-covered@3", "--fault", "way-free@12"]);
  const order = await client.order("DL-03", [36]);
  const blind = await client.untilVehicle("DL-03", (v) => v.activity === "blocked" && v.errors.some((error) => error.type === "scannerBlind"), "is blind");
  assert.equal(blind.reason.code, "field_violation");
  assert.ok(!blind.errors.some((error) => error.type === "obstacle"), JSON.stringify(blind.errors));
  await standsStill("DL-03");
  assert.equal((await client.untilEnded(order.id)).state, "Ended");
});

test("a wheel that slips: it stops, and nothing goes on without a person", async () => {
  await system.startOverTcp("TP-01", { seed: 5, timeFactor: 6, faults: ["slip=front drive:0.2@0.5"] });
  await client.untilReady("TP-01");
  const order = await client.order("TP-01", [2]);
  const stopped = await client.untilVehicle("TP-01", (v) => v.errors.some((error) => error.type === "wheelSlip"), "slips");
  assert.ok(stopped.errors.find((error) => error.type === "wheelSlip").fatal);
  await standsStill("TP-01");
  const held = await client.get(`/api/v1/job-orders/${order.id}`);
  assert.deepEqual([held.state, held.reason.code, held.reason.params.type], ["Interrupted", "vehicle_error", "wheelSlip"]);
  // The wheel slips on: a person's word brings it as far as its next turns.
  const stood = system.lastTruth("TP-01");
  await client.post("/api/v1/fleet/resume", { vehicles: ["TP-01"] });
  await until("it tries again", () => Math.hypot(system.lastTruth("TP-01").x_m - stood.x_m, system.lastTruth("TP-01").y_m - stood.y_m) > 0.001);
  await client.untilVehicle("TP-01", (v) => v.needs_resume_reason?.code === "vehicle_error", "asks again");
  await standsStill("TP-01");
});

test("dark cameras: the stop is not measured, the order is interrupted and says why", async () => {
  await start("MV-01", ["--fault", "camera-dark@1"]);
  const order = await client.order("MV-01", [13]);
  const failed = await client.untilOrder(order.id, (o) => o.state === "Interrupted", "is interrupted");
  assert.match(JSON.stringify(failed.reason), /no_marker_in_view|stop_failed|not_measured/);
  await standsStill("MV-01");
});

test("a hand-held control takes the vehicle out of the server's hands, and back nothing moves by itself", async () => {
  const socket = join(system.directory, "hand.sock");
  await start("DL-02", ["--hand-held", socket]);
  const order = await client.order("DL-02", [37]);
  await until("it drives", () => moves("DL-02"));
  await until("the control's socket", () => existsSync(socket));
  const control = await HandHeld.open(socket);
  const taken = await control.send({ do: "take" });
  assert.equal(taken.operating_mode, "MANUAL", JSON.stringify(taken));
  const interrupted = await client.untilOrder(order.id, (o) => o.state === "Interrupted", "is interrupted");
  assert.equal(interrupted.reason.code, "driven_by_hand");
  await until("it stands", async () => (await control.send({ do: "where" })).standing);

  const before = await control.send({ do: "where" });
  for (let i = 0; i < 30; ++i) assert.ok((await control.send({ do: "drive", vx_mps: -0.2 })).ok);
  await until("it has moved by hand", async () => {
    await control.send({ do: "drive", vx_mps: -0.2 });
    const { pose } = await control.send({ do: "where" });
    return Math.hypot(pose.x_m - before.pose.x_m, pose.y_m - before.pose.y_m) > 0.3;
  });
  const refused = await client.request("POST", "/api/v1/fleet/resume", { body: { vehicles: ["DL-02"] } });
  assert.equal(refused.status, 409);
  await until("it stands when let go", async () => (await control.send({ do: "where" })).standing);
  assert.equal((await control.send({ do: "give_back" })).operating_mode, "AUTOMATIC");
  control.close();
  await client.untilVehicle("DL-02", (v) => v.operating_mode === "AUTOMATIC" && v.needs_resume, "is back and waits for a person");
  await standsStill("DL-02");

  await client.post("/api/v1/fleet/resume", { vehicles: ["DL-02"] });
  assert.equal((await client.untilEnded(order.id)).state, "Ended");
});
