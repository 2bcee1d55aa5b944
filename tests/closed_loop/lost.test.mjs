// Vehicles that were carried off by a crane or a person: by the map of their hall they see that they are not where they
// believe to be, stop, say so, and are found again from where a person points to. Truth judges.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client, angleBetween } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";

const MM = 1e-3, DEG = Math.PI / 180;
const ID = "DL-01";
let system, client;

before(async () => {
  system = await System.create("landmark-lab");
  system.prepareVehicles([ID]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
});
after(() => system?.stop());

const vehicle = () => client.get(`/api/v1/vehicles/${ID}`);
const startAgent = (...faults) =>
  system.startAgent(ID, { seed: 51, timeFactor: 4, sensing: "analytic", extra: ["--drive", "servo", "--maps", "db/maps/landmark-lab", ...faults.flatMap((fault) => ["--fault", fault])] });
const truthNow = () => system.lastTruth(ID);
const wayBetween = (a, b) => Math.hypot(a.x_m - b.x_m, a.y_m - b.y_m);

/** A person stands beside it and points at it on the map: 0.1 m and 5 deg off. */
const pointAt = ({ x_m, y_m, heading_rad }) =>
  client.post(`/api/v1/vehicles/${ID}/init-position`, { x_m: x_m + 0.07, y_m: y_m - 0.07, heading_rad: heading_rad + 5 * DEG });

/** Wherever it stands, a person points there; then it knows better itself. */
async function isFound() {
  await client.untilVehicle(ID, (v) => v.link === "live" && !["vehicle_not_reported", "vehicle_silent"].includes(v.reason?.code), "has reported");
  await until("its first word of the truth", truthNow);
  if (!(await vehicle()).pose_known) await pointAt(truthNow());
  let last;
  await until(() => `its own place; truth ${JSON.stringify(truthNow())}, it says ${JSON.stringify(last)}`, async () => {
    const { pose_known, pose, pose_deviation_m, navigation, errors } = await vehicle();
    last = { pose_known, pose, pose_deviation_m, navigation, errors };
    return pose_known && wayBetween(pose, truthNow()) < 50 * MM && Math.abs(angleBetween(pose.heading_rad, truthNow().heading_rad)) < 1 * DEG;
  });
}

test("with its camera blind from the start it asks, and from where a person points to it finds itself by the walls", async () => {
  startAgent("camera-dark");
  await client.untilVehicle(ID, (v) => v.reason?.code === "pose_unknown", "asks for its pose");
  await isFound();
  const { navigation, pose_deviation_m } = await vehicle();
  assert.equal(navigation.by, "contours");
  assert.ok(navigation.explained > 0.8, JSON.stringify(navigation));
  assert.ok(pose_deviation_m < 0.1, `within ${pose_deviation_m} m by its own word`);
});

test("carried off while it stands, it knows that it is lost before anybody sends it", async () => {
  await system.kill(system.agents.get(ID));
  startAgent("carried=3,1.5,40@10");
  await client.untilVehicle(ID, (v) => v.pose_known && v.navigation?.explained > 0.8, "looks at its map again", 20);
  const lost = await client.untilVehicle(ID, (v) => v.errors.some(({ type }) => type === "contoursLost"), "is lost", 40);
  assert.equal(lost.pose_known, false);
  assert.equal(lost.reason?.code, "pose_unknown");
  const stands = truthNow();

  await isFound();
  assert.ok(wayBetween(stands, truthNow()) < 0.05, "it has not moved by itself");
  const order = await client.order(ID, [3]);
  const ended = await client.untilEnded(order.id, 40).catch(async (error) => { throw new Error(`${error.message}: ${JSON.stringify(await vehicle())}`); });
  assert.equal(ended.state, "Ended", JSON.stringify(ended.reason));
  assert.deepEqual((await client.stops(order.id)).map((stop) => [stop.number, stop.inside]), [[3, true]]);
});

test("carried off while it drives, it stops within three metres and asks", async () => {
  await system.kill(system.agents.get(ID));
  startAgent("driving:carried=1,1.5,-60@10"); // at its full speed: it needs two metres to brake
  await isFound();
  const orders = [];
  await until(async () => `it to be lost on a drive; ${JSON.stringify([await vehicle(), truthNow()])}`, async () => {
    const { pose_known } = await vehicle();
    if (!pose_known) return true;
    const last = orders.at(-1) && (await client.get(`/api/v1/job-orders/${orders.at(-1).id}`));
    if (!last || last.state === "Ended") orders.push(await client.order(ID, [orders.length % 2 === 0 ? 1 : 3]));
    return false;
  }, { timeout_s: 60 });
  const line = system.truth(ID);
  const jump = line.findLastIndex((at, i) => i > 0 && wayBetween(at, line[i - 1]) > 1);
  assert.ok(jump > 0, "it was carried off");
  assert.ok(line[jump].moving, "while it drove");
  await client.untilVehicle(ID, (v) => v.speed_mps === 0, "stands");
  const after = system.truth(ID).slice(jump);
  const driven = after.slice(1).reduce((way, at, i) => way + wayBetween(at, after[i]), 0);
  assert.ok(driven < 3, `driven ${driven} m on a wrong pose`);
  assert.ok((await vehicle()).errors.some(({ type }) => type === "contoursLost"));
});
