// Motion previews over REST: every mode of a platform and of a vehicle that moves every way, against the real server.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";

const VEHICLES = ["TP-01", "MV-01"];
let system, client, viewerToken;
before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles(VEHICLES);
  viewerToken = system.cli(["token", "create", "--role", "viewer", "--scope", "api"]).trim();
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  VEHICLES.forEach((id, i) => system.startAgent(id, { seed: 21 + i }));
  for (const id of VEHICLES) await client.untilReady(id);
});
after(() => system?.stop());

const ask = (body) => client.request("POST", "/api/v1/motion-previews", { body });
const modes = ({ options }) => new Map(options.map((option) => [option.mode, option]));
/** Area of a ring, counter-clockwise positive. */
const area = (ring) => ring.reduce((sum, p, i) => { const q = ring[(i + 1) % ring.length]; return sum + (p.x_m * q.y_m - q.x_m * p.y_m) / 2; }, 0);

function checkFeasible(option, type) {
  const { swept, segments } = option;
  assert.ok(segments.length > 0 && option.duration_s > 0, option.mode);
  assert.ok(Math.abs(segments.reduce((sum, s) => sum + s.duration_s, 0) - option.duration_s) < 1e-6, `${option.mode}: time`);
  assert.ok(Math.abs(swept.reduce((sum, ring) => sum + area(ring), 0) - option.swept_area_m2) < 1e-6, `${option.mode}: swept area`);
  assert.ok(option.swept_area_m2 > area(type.footprint) * 0.99, `${option.mode}: no less than the body`);
  assert.ok(option.clearance_m >= type.clearance_m, `${option.mode}: clearance`);
  assert.ok(option.expected_deviation.position_m > 0 && option.expected_deviation.heading_rad > 0, `${option.mode}: expected deviation`);
  assert.ok(option.wheels.max_speed_mps > 0 && option.wheels.max_speed_mps <= type.max_speed_mps + 1e-9, `${option.mode}: wheel speed`);
  if (type.kinematics !== "steered_platform") assert.equal(option.wheels.max_steering_rad, 0);
}

test("a platform with a load to a station: every mode is feasible or has its reason", async () => {
  const { status, body } = await ask({ vehicle: "TP-01", station: 2 });
  assert.equal(status, 200, JSON.stringify(body));
  assert.equal(body.loaded, true);
  const type = system.plant.model.vehicle_types.find((t) => t.id === "transport-platform");
  assert.deepEqual([...modes(body).keys()], ["linear", "fixed_axis_rotation", "self_rotation", "free"]);
  for (const option of body.options) {
    if (option.feasible) checkFeasible(option, type);
    else assert.match(option.reason.code, /^[a-z_]+$/);
  }
  assert.equal(body.options.filter((o) => o.suggested && o.feasible).length, 1);
  assert.equal(modes(body).get("self_rotation").reason.code, "not_in_place");
});

test("a Mecanum vehicle beside its goal: lateral, oblique and combined are each a motion of their own", async () => {
  const { pose } = system.plant.station(14);
  const type = system.plant.model.vehicle_types.find((t) => t.id === "measuring-vehicle");
  const to = (target) => ask({ vehicle: "MV-01", start: pose, target: { ...pose, ...target }, modes: ["lateral", "oblique", "combined"] });

  const beside = modes((await to({ y_m: pose.y_m - 2 })).body);
  const ahead = modes((await to({ x_m: pose.x_m + 2, y_m: pose.y_m - 2, heading_rad: Math.PI / 2 })).body);

  for (const option of [...beside.values(), ...ahead.values()].filter((o) => o.feasible)) checkFeasible(option, type);
  assert.equal(beside.get("lateral").segments.length, 1);
  assert.ok(Math.abs(beside.get("lateral").length_m - 2) < 1e-6);
  assert.equal(ahead.get("lateral").reason.code, "not_beside");
  assert.ok(ahead.get("combined").segments.every((s) => s.kind === "combined"));
  assert.ok(ahead.get("oblique").segments.some((s) => s.kind === "rotate"), "it turns only standing");
});

test("a preview from elsewhere and to a pose changes nothing", async () => {
  const before = await client.get("/api/v1/vehicles/TP-01");
  const { status, body } = await ask({ vehicle: "TP-01", start: { x_m: 30, y_m: 22, heading_rad: 0 }, target: { x_m: 45, y_m: 22, heading_rad: 0 }, loaded: false, modes: ["linear"] });
  assert.equal(status, 200, JSON.stringify(body));
  assert.equal(body.loaded, false);
  assert.ok(Math.abs(body.options[0].swept_area_m2 - (10.5 + 15) * 2.5) < 0.1);
  assert.equal((await client.get("/api/v1/job-orders")).items.length, 0);
  assert.deepEqual((await client.get("/api/v1/vehicles/TP-01")).pose, before.pose);
});

test("what it does not know is refused with field and remedy", async () => {
  const refused = async (body) => { const answer = await ask(body); assert.ok(answer.body.detail.length > 20); return [answer.status, answer.body.code, answer.body.field]; };
  const outside = { x_m: -500, y_m: 0, heading_rad: 0 };
  assert.deepEqual(await refused({ vehicle: "TP-99", station: 2 }), [422, "unknown_vehicle", "/vehicle"]);
  assert.deepEqual(await refused({ vehicle: "TP-01", station: 999 }), [422, "unknown_station", "/station"]);
  assert.deepEqual(await refused({ vehicle: "TP-01" }), [400, "station_or_target", "/station"]);
  assert.deepEqual(await refused({ vehicle: "TP-01", target: outside }), [422, "outside_hall", "/target"]);
  assert.deepEqual(await refused({ vehicle: "TP-01", station: 2, modes: ["fly"] }), [400, "not_one_of", "/modes/0"]);
});

test("only operators may ask", async () => {
  const as = async (token) => (await new Client(system.url, token).request("POST", "/api/v1/motion-previews", { body: { vehicle: "TP-01", station: 2 } })).status;
  assert.equal(await as("nobody"), 401);
  assert.equal(await as(viewerToken), 403);
  assert.equal(await as(system.apiToken), 200);
});
