// The hall that the walk goes through: nearly everything in it is in trouble, and real.
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";

/** Who walks. A name that is no word of either language, so that the crawl takes no "operator" for a name. */
export const kWalker = "chen7";

const kAgents = {
  "TP-01": { seed: 51 },
  "TP-02": { seed: 52, sensing: "analytic", extra: ["--fault", "wheel=front drive@1"] },
  "MV-01": { seed: 53, extra: ["--fault", "camera-dark@1"] },
  "OM-01": { seed: 54 },
  "DL-01": { seed: 55, sensing: "analytic", timeFactor: 1 }, // once round the hall and again: as long as the walk takes
};

/**
 * A broken wheel, a stop that was not measured, an order that waits for a vehicle that never connected, one that waits for closed
 * floor, an aborted one, one that is being driven, and one whose stop is on record.
 */
export async function startTroubledHall() {
  const system = await System.create("final-assembly");
  const password = `test-password-of-${kWalker}`;
  system.cli(["user", "add", kWalker, "--role", "operator", "--password-stdin"], password);
  system.passwords.set(kWalker, password);
  system.prepareVehicles(Object.keys(kAgents));
  await system.startServer();
  const client = new Client(system.url, system.apiToken);
  for (const [id, options] of Object.entries(kAgents)) system.startAgent(id, options);
  for (const id of Object.keys(kAgents)) await client.untilReady(id);

  const done = await client.order("TP-01", [2]);
  const unmeasured = await client.order("MV-01", [13]);
  const aborted = await client.order("OM-01", [28]);
  await client.untilVehicle("OM-01", (v) => v.activity === "moving", "drives");
  await client.post(`/api/v1/job-orders/${aborted.id}/cancel`);
  const waiting = await client.order("TP-03", [5]);
  await client.untilEnded(done.id);
  await client.untilEnded(aborted.id);
  await client.untilOrder(unmeasured.id, (o) => o.state === "Interrupted", "is interrupted");
  await client.untilVehicle("TP-02", (v) => v.wheels.some((w) => w.fault !== ""), "has a broken wheel");
  const [stop] = await client.stops(done.id);
  const { pose } = system.plant.station(3);
  const corners = [[-4, -4], [4, -4], [4, 4], [-4, 4]].map(([x, y]) => [pose.x_m + x, pose.y_m + y]);
  await client.post("/api/v1/closures", { name: "Work", hall: system.plant.model.halls[0].id, outline: corners.map(([x_m, y_m]) => ({ x_m, y_m })) });
  const barred = await client.order("TP-01", [3]);
  await client.untilOrder(barred.id, (o) => o.reason?.code === "floor_closed" || o.steps[0].state !== "pending", "waits for the floor");
  const driven = await client.order("DL-01", [40, 34, 40, 34]);
  await client.untilVehicle("DL-01", (v) => v.activity === "moving", "drives");
  return { system, client, stop, orders: { done, unmeasured, aborted, waiting, barred, driven } };
}
