// Each sense of each family in turn fails at full speed, between stations and where no person looks. The vehicle goes on by what
// it has left and says which sense it lacks, or it stands inside the floor that it holds and asks. Truth judges.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";

const HELD_M = 0.1;
const OVER_TCP = 5; // faster: between two lines of the truth, 50 ms, what it gains in speed is 1.6 mm of way

/** One vehicle of a plant whose sense fails on its way to the stations: what it says, and how its order stands in the end. */
async function blinded(t, { plant, id, faults, stations, maps = false, overTcp = false, says }) {
  const system = await System.create(plant);
  t.after(() => system.stop());
  system.prepareVehicles([id]);
  await system.startServer();
  const client = new Client(system.url, system.apiToken);
  const held = faults.map((fault) => `driving:${fault}@1`);
  const extra = ["--drive", "servo", ...(maps ? ["--maps", `db/maps/${plant}`] : []), ...held.flatMap((fault) => ["--fault", fault])];
  if (overTcp) await system.startOverTcp(id, { seed: 61, timeFactor: OVER_TCP, faults: held });
  else system.startAgent(id, { seed: 61, sensing: "analytic", extra });
  await client.untilReady(id);
  const order = await client.order(id, stations);
  const end = await client.untilOrder(order.id, (o) => ["Ended", "Aborted", "Interrupted"].includes(o.state), "ends or asks", 120);
  const vehicle = await until(`${id} to say what it lacks`, async () => {
    const seen = await client.get(`/api/v1/vehicles/${id}`);
    return says(seen) && seen;
  }, { timeout_s: 20 });
  await until("it stands", () => !system.lastTruth(id).moving);
  for (const line of overTcp ? system.truthWithBelief(id) : system.truth(id)) {
    if (!line.moving || line.order_id === "") continue;
    const off_m = Math.hypot(line.x_m - line.believed.x_m, line.y_m - line.believed.y_m);
    assert.ok(off_m <= HELD_M, `${id} drove ${off_m} m from where it believed to be`);
  }
  const stops = await client.stops(order.id);
  assert.ok(stops.every((stop) => stop.inside), JSON.stringify(stops));
  return { end, vehicle, stops };
}
const lacks = (...types) => ({ pose_known, errors }) => !pose_known && types.every((type) => errors.some((error) => error.type === type));

test("a platform whose cameras are dark drives as far as its wheels tell it, then stands, names them and asks", async (t) => {
  const { end } = await blinded(t, { plant: "final-assembly", id: "TP-01", overTcp: true, faults: ["camera-dark"], stations: [7], says: lacks("poseUncertain", "codesNoneInView") });
  assert.deepEqual([end.state, end.reason.code], ["Interrupted", "pose_lost"]);
});

test("a delivery vehicle whose cameras are dark drives on by what its scanners see, and its stop is not measured", async (t) => {
  const { end } = await blinded(t, { plant: "final-assembly", id: "DL-01", faults: ["camera-dark"], stations: [36], maps: true, says: (v) => v.pose_known });
  assert.deepEqual([end.state, end.reason.code], ["Interrupted", "stop_not_measured"]);
  assert.match(end.reason.params.why, /no_marker_in_view/);
});

test("a measuring vehicle whose reflector scanner is covered drives on by codes, and says that it sees none", async (t) => {
  const { end, stops } = await blinded(t, { plant: "measuring-hall", id: "MV-01", faults: ["scanner-covered"], stations: [6], says: (v) => v.reflectors_in_view === 0 });
  assert.equal(end.state, "Ended", JSON.stringify(end.reason));
  assert.equal(stops.length, 1);
});

test("with its cameras dark as well it stands, names both and asks", async (t) => {
  const { end } = await blinded(t, { plant: "measuring-hall", id: "MV-01", faults: ["scanner-covered", "camera-dark"], stations: [6], says: lacks("poseUncertain", "codesNoneInView", "reflectorsLost") });
  assert.deepEqual([end.state, end.reason.code], ["Interrupted", "pose_lost"]);
});

test("a Mecanum platform that loses all light stands, says so and asks", async (t) => {
  const { end } = await blinded(t, { plant: "igps-cell", id: "OM-01", faults: [1, 2, 3, 4, 5, 6].map((n) => `transmitter-dark=tx-${n}`), stations: [6, 2], says: lacks("poseUncertain", "lightLost") });
  assert.deepEqual([end.state, end.reason.code], ["Interrupted", "pose_lost"]);
});
