// An order waits for a vehicle that nobody has told where it stands. A person's word and its own looks come late and move what it
// believes by some degrees: it takes the order and says that its drive has to be led there first, and why is on the screen.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";

const AT = { x_m: 61, y_m: 20.1, heading_rad: -0.1 }, OFF_M = 0.07, OFF_RAD = (5 * Math.PI) / 180;

test("an order that waits until the drive is led to the pose known since has a reason", async (t) => {
  const system = await System.create("pulse-line");
  t.after(() => system.stop());
  system.prepareVehicles(["TP-01"]);
  await system.startServer();
  const client = new Client(system.url, system.apiToken);
  const line = { t_ms: Date.now(), vehicle: "TP-01", ...AT, moving: false, order_id: "", last_node_seq: 0, base_end_seq: 0 };
  writeFileSync(`${system.truthLog}.TP-01`, `${JSON.stringify(line)}\n`);
  system.startAgent("TP-01", { seed: 70, timeFactor: 6, sensing: "analytic", extra: ["--drive", "servo", "--maps", "db/maps/pulse-line"] });
  await client.untilVehicle("TP-01", (v) => v.link === "live" && v.reason?.code === "pose_unknown", "asks");
  const order = await client.order("TP-01", [5]);
  await client.untilOrder(order.id, (o) => o.reason !== undefined, "waits for its pose");
  await client.post("/api/v1/vehicles/TP-01/init-position", { x_m: AT.x_m + OFF_M, y_m: AT.y_m + OFF_M, heading_rad: AT.heading_rad + OFF_RAD });
  const ended = await client.untilEnded(order.id, 150);
  assert.equal(ended.state, "Ended", JSON.stringify(ended.reason));
  const events = await client.events();
  const at = (wanted) => events.find(wanted)?.seq;
  const accepted = at(({ type, vehicle }) => type === "leg.accepted" && vehicle === "TP-01");
  const said = at(({ type, vehicle, params }) => type === "vehicle.error" && vehicle === "TP-01" && params.type === "poseTaken");
  assert.ok(said !== undefined, "says why it stands with its order");
  assert.ok(Math.abs(said - accepted) < 20, `when it has taken its order (${accepted}), not ${said}`);
  assert.equal(events.filter(({ type }) => type === "vehicle.pose_lost").length, 0);
  const { errors } = await client.get("/api/v1/vehicles/TP-01");
  assert.ok(errors.every(({ type }) => type !== "poseTaken"), "and no longer than it is so");
});
