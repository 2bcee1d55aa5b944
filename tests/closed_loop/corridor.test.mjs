// A lane with a corridor: the vehicle goes round what stands on its line and is back on it for its stop; where the corridor
// is too narrow it waits, and says so. By the true poses of the simulated world's own log.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";

const LANE_Y_M = 20;
const BOX = { x_m: 48, y_m: 20, half_m: 0.25 }; // on the line from station 3 to 5
let system, client, corridor;

before(async () => {
  system = await System.create("pulse-line");
  corridor = system.plant.model.roadmap.edges.find((edge) => edge.id === "st03.st04").corridor;
  system.prepareVehicles(["TP-01"]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  await system.startOverTcp("TP-01", { seed: 11, timeFactor: 6, faults: [`obstacle=${BOX.x_m},${BOX.y_m}@0`] });
  await client.untilReady("TP-01");
});
after(() => system?.stop());

const inHall = (pose, { x_m, y_m }) => {
  const [c, s] = [Math.cos(pose.heading_rad), Math.sin(pose.heading_rad)];
  return { x_m: pose.x_m + c * x_m - s * y_m, y_m: pose.y_m + s * x_m + c * y_m };
};
/** Least distance of the box from the outline (a convex polygon), 0 when they touch; both have long edges and few corners. */
function distanceToBox(outline) {
  const signs = [-1, 1];
  const box = signs.flatMap((a) => signs.map((b) => ({ x_m: BOX.x_m + a * BOX.half_m, y_m: BOX.y_m + a * b * BOX.half_m })));
  const toSegment = (p, a, b) => {
    const way = { x: b.x_m - a.x_m, y: b.y_m - a.y_m };
    const t = Math.max(0, Math.min(1, ((p.x_m - a.x_m) * way.x + (p.y_m - a.y_m) * way.y) / (way.x ** 2 + way.y ** 2)));
    return Math.hypot(p.x_m - a.x_m - t * way.x, p.y_m - a.y_m - t * way.y);
  };
  const edges = (ring) => ring.map((p, i) => [p, ring[(i + 1) % ring.length]]);
  const inside = (p, ring) => edges(ring).every(([a, b]) => (b.x_m - a.x_m) * (p.y_m - a.y_m) - (b.y_m - a.y_m) * (p.x_m - a.x_m) >= 0);
  if (inside(BOX, outline)) return 0;
  return Math.min(...box.flatMap((p) => edges(outline).map(([a, b]) => toSegment(p, a, b))), ...outline.flatMap((p) => edges(box).map(([a, b]) => toSegment(p, a, b))));
}

test("the platform goes round a box on its line, inside the corridor, and stops inside its tolerance", async () => {
  const there = await client.order("TP-01", [3]);
  assert.equal((await client.untilEnded(there.id)).state, "Ended");
  const from = system.truth("TP-01").length;
  const order = await client.order("TP-01", [{ station: 5, motion_mode: "linear" }]);
  await client.untilVehicle("TP-01", (v) => v.errors.some((error) => error.type === "obstacle"), "is before the box");
  await client.untilVehicle("TP-01", (v) => v.errors.some((error) => error.type === "going_round"), "goes round it", 60);
  assert.equal((await client.untilEnded(order.id, 120)).state, "Ended");
  assert.ok((await client.stops(order.id)).at(-1).inside);

  const type = system.plant.model.vehicle_types.find((one) => one.id === "transport-platform");
  const poses = system.truth("TP-01").slice(from).filter((line) => line.vehicle === "TP-01");
  let aside_m = 0;
  for (const pose of poses) {
    for (const outline of [type.footprint, type.load_footprint].map((ring) => ring.map((corner) => inHall(pose, corner)))) {
      assert.ok(distanceToBox(outline) > 0.05, `at ${JSON.stringify(pose)} it is ${distanceToBox(outline)} m from the box`);
      if (pose.x_m < 32 || pose.x_m > 68) continue; // it turns at the stations, on floor of their own
      for (const corner of outline) {
        assert.ok(corner.y_m - LANE_Y_M < corridor.left_m && LANE_Y_M - corner.y_m < corridor.right_m, `at ${JSON.stringify(pose)} it leaves the corridor`);
      }
    }
    aside_m = Math.max(aside_m, Math.abs(pose.y_m - LANE_Y_M));
  }
  assert.ok(aside_m > 1, `it went only ${aside_m} m aside`);
});
