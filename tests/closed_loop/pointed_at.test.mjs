// Vehicles that stand in the middle of a hall, with no code below them and no wall near: a person points at each on the touch
// screen, 0.1 m and 5 deg off, and nobody does more. Each finds itself from there and drives to its stop. Truth judges.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { test } from "node:test";
import { Client, angleBetween } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";
import { randomOf } from "../harness/random.mjs";

const FACTOR = 6, DEG = Math.PI / 180, PERSON_M = 0.1, PERSON_DEG = 5, DRIVES_M = 0.1, FOUND_DEG = 0.5;

const HALLS = {
  "final-assembly": [
    { id: "TP-01", at: { x_m: 40, y_m: 20.2, heading_rad: 0.2 }, to: 4 },
    { id: "TP-02", at: { x_m: 89.5, y_m: 20, heading_rad: 1.5 }, to: 7 },
    { id: "OM-01", at: { x_m: 21, y_m: 4.1, heading_rad: 0.05 }, to: 28 },
    { id: "MV-01", at: { x_m: 45, y_m: 38, heading_rad: 3.1 }, to: 17 },
    { id: "DL-01", at: { x_m: 57.4, y_m: 29, heading_rad: 1.6 }, to: 40 },
    { id: "DL-02", at: { x_m: 100, y_m: 50.4, heading_rad: 0 }, to: 33 },
  ],
  "pulse-line": [{ id: "TP-01", at: { x_m: 61, y_m: 20.1, heading_rad: -0.1 }, to: 5 }],
};

const wayBetween = (a, b) => Math.hypot(a.x_m - b.x_m, a.y_m - b.y_m);

for (const [plant, starts] of Object.entries(HALLS)) {
  test(`in ${plant} a person's place is enough to be found again, and to drive to a stop`, async (t) => {
    const system = await System.create(plant);
    t.after(() => system.stop());
    const random = randomOf(5);
    system.prepareVehicles(starts.map(({ id }) => id));
    await system.startServer();
    const client = new Client(system.url, system.apiToken);
    for (const [i, { id, at }] of starts.entries()) {
      const line = { t_ms: Date.now(), vehicle: id, ...at, moving: false, order_id: "", last_node_seq: 0, base_end_seq: 0 };
      writeFileSync(`${system.truthLog}.${id}`, `${JSON.stringify(line)}\n`);
      const how = { seed: 70 + i, timeFactor: FACTOR, extra: ["--maps", `db/maps/${plant}`] };
      if (plant === "pulse-line") await system.startOverTcp(id, how);
      else system.startAgent(id, { ...how, sensing: "analytic", extra: ["--drive", "servo", ...how.extra] });
    }
    await Promise.all(starts.map(async ({ id, at, to }) => {
      const first = await client.untilVehicle(id, (v) => v.link === "live" && (v.pose_known || v.reason?.code === "pose_unknown"), "asks");
      if (!first.pose_known) {
        const away = random() * 2 * Math.PI, turned = (random() < 0.5 ? 1 : -1) * PERSON_DEG * DEG;
        await client.post(`/api/v1/vehicles/${id}/init-position`, { x_m: at.x_m + PERSON_M * Math.cos(away), y_m: at.y_m + PERSON_M * Math.sin(away), heading_rad: at.heading_rad + turned });
      }
      const found = await client.untilVehicle(id, (v) => v.pose_known && (first.pose_known || v.fixes.some(({ by }) => by === "person")) && v.navigation?.by !== "person" && v.pose_deviation_m < DRIVES_M && Math.abs(angleBetween(v.pose.heading_rad, at.heading_rad)) < FOUND_DEG * DEG, "finds itself from there");
      assert.ok(wayBetween(found.pose, at) <= found.pose_deviation_m, `${id} is ${wayBetween(found.pose, at)} m off and holds it for ${found.pose_deviation_m} m at most, by ${found.navigation.by}`);

      const order = await client.order(id, [to]);
      const ended = await client.untilEnded(order.id, 100).catch(async (error) => { throw new Error(`${error.message}: ${JSON.stringify(await client.get(`/api/v1/vehicles/${id}`))}`); });
      assert.equal(ended.state, "Ended", `${id}: ${JSON.stringify(ended.reason)}`);
      assert.deepEqual((await client.stops(order.id)).map((stop) => [stop.number, stop.inside]), [[to, true]]);
    }));
    const told = (await client.events()).filter(({ type }) => type === "vehicle.pose_lost");
    assert.deepEqual(told.map(({ vehicle }) => vehicle), [], "nobody lost itself again");
  });
}
