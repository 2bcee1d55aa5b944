// An order waits for a vehicle that nobody has told where it stands. Then a person points at it on the touch screen, 0.1 m and 5 deg
// off, and does no more: the vehicle finds itself first, its way begins where it truly stands, and it arrives.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";

const AT = { x_m: 61, y_m: 20.1, heading_rad: -0.1 }, OFF_M = 0.07, OFF_RAD = (5 * Math.PI) / 180;

test("an order given before a person points to where its vehicle stands is driven from where it finds itself", async (t) => {
  const system = await System.create("pulse-line");
  t.after(() => system.stop());
  system.prepareVehicles(["TP-01"]);
  await system.startServer();
  const client = new Client(system.url, system.apiToken);
  const line = { t_ms: Date.now(), vehicle: "TP-01", ...AT, moving: false, order_id: "", last_node_seq: 0, base_end_seq: 0 };
  writeFileSync(`${system.truthLog}.TP-01`, `${JSON.stringify(line)}\n`);
  await system.startOverTcp("TP-01", { seed: 70, timeFactor: 6, extra: ["--maps", "db/maps/pulse-line"] });
  await client.untilVehicle("TP-01", (v) => v.link === "live" && v.reason?.code === "pose_unknown", "asks");
  const order = await client.order("TP-01", [5]);
  await client.untilOrder(order.id, (o) => o.reason?.code === "pose_unknown", "waits for its pose");
  await client.post("/api/v1/vehicles/TP-01/init-position", { x_m: AT.x_m + OFF_M, y_m: AT.y_m + OFF_M, heading_rad: AT.heading_rad + OFF_RAD });

  const ended = await client.untilEnded(order.id, 150);
  assert.equal(ended.state, "Ended", JSON.stringify(ended.reason));
  assert.deepEqual((await client.stops(order.id)).map((stop) => [stop.number, stop.inside]), [[5, true]]);
  const events = await client.events();
  const waits = events.filter(({ type }) => type === "job_order.waits").map(({ params }) => params.reason);
  assert.ok(waits.includes("pose_vague"), `says what it waits for, not only ${waits}`);
  const wrong = events.filter(({ type, params }) => type === "vehicle.pose_lost" || (type === "vehicle.error" && params.fatal));
  assert.deepEqual(wrong.map(({ type, params }) => `${type} ${params.type}`), []);
});
