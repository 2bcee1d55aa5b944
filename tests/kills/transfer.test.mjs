// The server dies over the word of a platform that it has taken an aircraft over: that was not stored, so the next server has the aircraft
// where it hung. The brackets say otherwise: nothing drives until a person has said where it is, and nothing is lost or taken twice.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Client } from "../harness/client.mjs";
import { morning } from "../harness/plants.mjs";
import { System } from "../harness/processes.mjs";

const kId = "TP-01", kLoad = "A-101";

test("killed between a finished take-over and its commit: it stands, says why, and drives when a person has said what it carries", async (t) => {
  const system = await System.create(morning(1, { height_m: 0.02 }));
  t.after(() => system.stop());
  system.prepareVehicles([kId]);
  // Nothing else is stored of loads: the first time is the end of the take-over.
  await system.startServer([], { PULSELINE_CRASH_AT: "commit_after_load:1" });
  const client = new Client(system.url, system.apiToken), dying = system.server;
  system.startAgent(kId, { seed: 22, timeFactor: 4, sensing: "analytic" });
  await client.untilReady(kId);
  const asked = await client.request("POST", `/api/v1/vehicles/${kId}/lifts`, { body: { type: "pick", load: kLoad } });
  assert.equal(asked.status, 202);
  assert.equal((await dying.ended).signal, "SIGKILL");

  await system.startServer();
  const felt = await client.untilVehicle(kId, (v) => v.link === "live" && v.load_fault !== undefined, "feels what nobody knows of", 60);
  assert.equal(felt.load, undefined);
  assert.equal(felt.load_fault.code, "load_unknown");
  assert.equal((await client.get(`/api/v1/loads/${kLoad}`)).station, 1);
  if (felt.needs_resume) await client.post("/api/v1/fleet/resume", { vehicles: [kId] });
  const order = await client.order(kId, [2]);
  await client.untilOrder(order.id, (o) => o.reason?.code === "load_unknown", "waits for its load");
  const { x_m, y_m } = system.lastTruth(kId);

  const said = await client.request("PUT", `/api/v1/loads/${kLoad}/place`, { body: { vehicle: kId } });
  assert.equal(said.status, 202, JSON.stringify(said.body));
  assert.deepEqual([system.lastTruth(kId).x_m, system.lastTruth(kId).y_m], [x_m, y_m], "it stood until then");
  assert.equal((await client.untilEnded(order.id, 180)).state, "Ended");
  assert.deepEqual((await client.stops(order.id)).map((stop) => [stop.load, stop.inside]), [[kLoad, true]]);
  const { items } = await client.get(`/api/v1/loads/${kLoad}/moves`);
  assert.deepEqual(items.map(({ from, to }) => [from, to]), [[{ station: 1 }, { vehicle: kId }]], "one move, not two");
});
