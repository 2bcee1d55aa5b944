// Codes of the lanes do not lie where the survey says: two were exchanged, one was moved. A vehicle that passes them names
// them, steers by none of them, and stops where it should. The world is another plant file than the server's.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";
import { writeWorld } from "../harness/world.mjs";

const MM = 1e-3;
const ID = "DL-01";
const EXCHANGED = ["lane-317", "lane-311"], MOVED = "lane-314", MOVED_BY_M = 0.03;
let system, client;

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles([ID]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  const world = writeWorld(system, ({ markers }) => {
    const code = (id) => markers.find((marker) => marker.id === id);
    const [one, other] = EXCHANGED.map(code);
    [one.payload, other.payload] = [other.payload, one.payload];
    code(MOVED).pose.y_m += MOVED_BY_M;
  });
  system.startAgent(ID, { seed: 21, world });
  await client.untilReady(ID);
});
after(() => system?.stop());

test("codes that were exchanged or moved are named, and no stop is worse for them", async () => {
  const order = await client.order(ID, [34, 37, 34]);
  const named = new Set(), refused = new Map();
  await until(() => `the order to end; named: ${[...named]}`, async () => {
    const { errors, fixes = [] } = await client.get(`/api/v1/vehicles/${ID}`);
    for (const fix of fixes) if (fix.result === "refused") refused.set(fix.code, fix);
    for (const { type, description } of errors) if (type === "codeRefused") named.add(description);
    return ["Ended", "Aborted"].includes((await client.get(`/api/v1/job-orders/${order.id}`)).state);
  }, { timeout_s: 120, every_ms: 50 });
  assert.equal((await client.get(`/api/v1/job-orders/${order.id}`)).state, "Ended");
  const says = (payload) => [...named].some((text) => text.includes(payload));
  for (const id of [...EXCHANGED, MOVED]) {
    const { payload } = system.plant.model.markers.find((marker) => marker.id === id);
    assert.ok(says(payload), `${id} (${payload}) was not named: ${[...named]}`);
  }
  // The list of its last fixes says why each was refused, and how far a moved one would have led it astray.
  const why = (id) => refused.get(system.plant.model.markers.find((marker) => marker.id === id).payload);
  assert.equal(why(MOVED)?.why, "innovation_gate", JSON.stringify([...refused.values()]));
  assert.ok(Math.abs(why(MOVED).moved_m - MOVED_BY_M) < 0.015, JSON.stringify(why(MOVED)));
  for (const id of EXCHANGED) assert.equal(why(id)?.why, "other_code", JSON.stringify([...refused.values()]));
  const stops = (await client.stops(order.id)).filter((stop) => stop.attempt === 1);
  assert.deepEqual(stops.map((stop) => [stop.number, stop.inside]), [[34, true], [37, true], [34, true]]);
  for (const { number, arrival } of stops.slice(1)) {
    assert.ok(arrival, `station ${number}: its code was not in view where the drive ended`);
    assert.ok(Math.hypot(arrival.dx_m, arrival.dy_m) <= 20 * MM, `station ${number}: the drive ended ${arrival.dx_m / MM}, ${arrival.dy_m / MM} mm off`);
  }
});
