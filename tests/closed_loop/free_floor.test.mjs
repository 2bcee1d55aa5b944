// A measuring vehicle in a hall without lanes: its ways come from the search over the hall's occupancy grid (Li 2022, eq. 10). It
// drives them round the fuselage and round floor that is closed, and its stops are good. Truth judges.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { BUILD, Plant, System } from "../harness/processes.mjs";
import { withoutLanes } from "../harness/world.mjs";

const ID = "MV-01";
let system, client;

before(async () => {
  const file = withoutLanes("measuring-hall");
  system = await System.create(file);
  assert.doesNotMatch(execFileSync(join(BUILD, "pulseline"), ["plant", "validate", file], { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] }), /warning/, "nothing stands in the way of an order");
  system.prepareVehicles([ID]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  system.startAgent(ID, { seed: 31, extra: ["--drive", "servo"] });
  await client.untilReady(ID);
});
after(() => system?.stop());

/** Whether its middle came nearer to the fuselage than half its width. */
const [fuselage] = new Plant("measuring-hall").model.areas;
const [left, right] = [Math.min(...fuselage.outline.map(({ x_m }) => x_m)), Math.max(...fuselage.outline.map(({ x_m }) => x_m))];
function passesFuselage({ x_m, y_m }) {
  return x_m > left && x_m < right && y_m > 9 - 0.7 && y_m < 9 + 0.7;
}

/** Drives to the stations; the truth of its way. */
async function drivenTo(stations) {
  const from = system.truth(ID).length;
  const order = await client.order(ID, stations);
  const { state, reason } = await client.untilEnded(order.id, 150);
  assert.equal(state, "Ended", JSON.stringify(reason));
  assert.deepEqual((await client.stops(order.id)).map(({ number, inside }) => [number, inside]), stations.map((number) => [number, true]));
  return system.truth(ID).slice(from);
}

test("without a lane it finds its way round the fuselage, shown before it is sent", async () => {
  const preview = await client.post("/api/v1/job-orders?dryRun=true", { vehicle: ID, steps: [{ station: 5 }] });
  assert.ok(preview.accepted, JSON.stringify(preview));
  const linear = preview.steps[0].options.find(({ mode }) => mode === "linear");
  assert.ok(linear.feasible && linear.swept.length > 0, JSON.stringify(linear).slice(0, 300));
  const way = await drivenTo([5, 2, 4]);
  assert.ok(!way.some(passesFuselage), "it drove into the fuselage");
  assert.ok(way.some(({ y_m }) => y_m < 5) && way.some(({ y_m }) => y_m > 13), "it was on both sides");
});

test("floor that is closed on its way is gone round", async () => {
  await drivenTo([4]);
  await client.post("/api/v1/closures", { hall: system.plant.model.halls[0].id, outline: [[2, 8], [8.5, 8], [8.5, 10], [2, 10]].map(([x_m, y_m]) => ({ x_m, y_m })), name: "Work" });
  const way = await drivenTo([1]);
  assert.ok(!way.some(({ x_m, y_m }) => x_m > 2 && x_m < 8.5 && y_m > 8 && y_m < 10), "it drove over closed floor");
  assert.ok(way.some(({ x_m }) => x_m > right), "the way round leads past the fuselage's other end");
});
