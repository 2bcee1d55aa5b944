// What a platform does standing, with a real agent: charging of its own accord, parking feet round assembly work, being taken out.
import assert from "node:assert/strict";
import { test } from "node:test";
import { startHall } from "../harness/hall.mjs";

const PLANT = {
  spots: { west: [20, 40, 1], middle: [45, 40, 2], east: [70, 40, 3], bay: [45, 62, 4] }, lanes: ["west-middle", "middle-east", "middle-bay"],
  vehicles: [1], chargers: [4],
};

const hall = (t, plant, battery) => startHall(t, plant, () => ({ extra: ["--battery", String(battery)] }));

test("a platform with a low battery drives to the charger, and leaves it for an order when it is enough", async (t) => {
  const { client } = await hall(t, { ...PLANT, battery: { critical_percent: 15, low_percent: 16, enough_percent: 18 } }, 14);
  const order = await client.order("V1", [3]);
  await client.untilVehicle("V1", (v) => v.activity === "charging", "charges");
  assert.equal((await client.get("/api/v1/vehicles/V1")).at_station, "s4");
  const waiting = await client.untilOrder(order.id, (o) => o.reason?.code === "battery_charging", "waits for the battery");
  assert.equal(waiting.state, "AllowedToStart");
  await client.untilOrder(order.id, (o) => o.state === "Ended", "ended", 240);
  const types = (await client.events()).map((event) => event.type);
  assert.equal(types.filter((type) => type === "vehicle.goes_charging").length, 1);
});

test("parking feet go down after the stop, bar the next drive, and go up before it when that is asked for", async (t) => {
  const { client } = await hall(t, PLANT, 90);
  const lowered = await client.order("V1", [{ station: 2, after: [{ type: "lowerParking" }] }]);
  await client.untilOrder(lowered.id, (o) => o.state === "Ended", "ended");
  await client.untilVehicle("V1", (v) => v.parking_feet.every((foot) => foot.extension_m > 0.1), "stands on its feet");
  const barred = await client.order("V1", [3]);
  await client.untilOrder(barred.id, (o) => o.reason?.code === "parking_feet_down", "waits for the feet");
  await client.post(`/api/v1/job-orders/${barred.id}/cancel`);
  const raised = await client.order("V1", [{ station: 3, before: [{ type: "raiseParking" }] }]);
  await client.untilOrder(raised.id, (o) => o.state === "Ended", "ended");
});

test("the order of a platform that is taken out goes to the other one", async (t) => {
  const { client } = await hall(t, { ...PLANT, vehicles: [1, 3] }, 90);
  const order = await client.order(undefined, [4]);
  const running = await client.untilOrder(order.id, (o) => o.state === "Running", "runs");
  const out = running.vehicle, other = out === "V1" ? "V2" : "V1";
  const answer = await client.request("PUT", `/api/v1/vehicles/${out}/integration`, { body: { level: "respect" } });
  assert.equal(answer.status, 202, JSON.stringify(answer.body));
  const refused = await client.request("PUT", `/api/v1/vehicles/${out}/integration`, { body: { level: "notice" } });
  assert.equal(refused.status, 409);
  assert.equal(refused.body.type.split(":").at(-1), "off_floor_unconfirmed");
  const ended = await client.untilOrder(order.id, (o) => o.state === "Ended", "ended", 120);
  assert.equal(ended.vehicle, other);
});
