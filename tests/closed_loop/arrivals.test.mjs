// What a drive of a machine over TCP missed its station by, in a plant whose lanes have lost their codes: over codes it misses by too little to tell
// where it had ended from where it was adjusted to.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";
import { writeWorld } from "../harness/world.mjs";

const MM = 1e-3;
let system, client;

before(async () => {
  system = await System.create("pulse-line");
  system.prepareVehicles(["TP-01"]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  const world = writeWorld(system, (plant) => {
    const ofStations = new Set(plant.stations.flatMap((station) => station.markers ?? []));
    plant.markers = plant.markers.filter((marker) => ofStations.has(marker.id));
  });
  await system.startOverTcp("TP-01", { seed: 7, world });
  await client.untilReady("TP-01");
});
after(() => system?.stop());

test("what each drive missed its station by is kept, was true, and the next preview is learned from it", async () => {
  for (const steps of [[2, 4], [2, 4], [2, 4], [2, 4], [2, 4]]) {
    const order = await client.order("TP-01", steps.map((station) => ({ station, motion_mode: "linear" })));
    assert.equal((await client.untilEnded(order.id)).state, "Ended");
  }
  const stops = (await client.get("/api/v1/stop-records?vehicle=TP-01&limit=100")).items.filter((s) => s.attempt === 1 && s.arrival);
  assert.ok(stops.length >= 8, `only ${stops.length} stops tell where their drive had ended`);
  const truth = system.truthWithBelief("TP-01");
  let adjusted = 0;
  for (const stop of stops) {
    const { pose } = system.plant.station(stop.number);
    const x = pose.x_m + stop.arrival.dx_m, y = pose.y_m + stop.arrival.dy_m;
    const ended = truth.find((row) => row.order_id === stop.leg && !row.moving && row.last_node_seq === row.base_end_seq && Math.hypot(row.x_m - pose.x_m, row.y_m - pose.y_m) < 0.2);
    assert.ok(ended, `the truth of the drive to ${stop.number} is there`);
    const off = Math.hypot(ended.x_m - x, ended.y_m - y);
    assert.ok(off <= 1.5 * MM, `the drive to ${stop.number} ended ${off / MM} mm beside where the record says`);
    if (Math.hypot(stop.arrival.dx_m - stop.dx_m, stop.arrival.dy_m - stop.dy_m) > 2 * MM) ++adjusted;
  }
  assert.ok(adjusted >= 3, `only ${adjusted} of ${stops.length} stops were adjusted by more than 2 mm`);
  const taught = stops.filter((s) => s.mode === "linear" && s.arrival.expected_m > 0);
  assert.ok(taught.length >= 3, `${taught.length} linear drives began at a measured stop`);
  const preview = await client.post("/api/v1/job-orders?dryRun=true", { vehicle: "TP-01", steps: [{ station: 3, motion_mode: "linear" }] });
  const { expected_deviation } = preview.steps[0].options.find((option) => option.mode === "linear");
  assert.equal(expected_deviation.arrivals, Math.min(20, taught.length));
  assert.ok(expected_deviation.position_m > 0.5 * MM && expected_deviation.position_m < 60 * MM, JSON.stringify(expected_deviation));
});
