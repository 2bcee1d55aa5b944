// Vehicles that meet, with real agents over real sockets: head on in a corridor, four round a crossing, a platform that backs out
// for another, a breakdown on the only road. Each wait has to show in the wait-for graph.
import assert from "node:assert/strict";
import { test } from "node:test";
import { startHall } from "../harness/hall.mjs";
import { until } from "../harness/processes.mjs";

/** Runs `act` with server and agents up; watches the wait-for graph all the while. */
async function meeting(t, plant, act, agentOptions = {}) {
  const { system, client, ids } = await startHall(t, plant, (id) => agentOptions[id] ?? {});
  const seen = new Set();
  let watching = true;
  const watch = (async () => {
    while (watching) {
      const { waits, stopped } = await client.get("/api/v1/traffic");
      assert.equal(stopped, undefined, "the monitor found a violation");
      for (const { vehicle, waits_for } of waits) if (waits_for) seen.add(`${vehicle} waits for ${waits_for}`);
      await new Promise((done) => setTimeout(done, 20));
    }
  })();
  try {
    await act({ system, client, seen });
  } finally {
    watching = false;
    await watch;
  }
  assertApart(system, ids);
  return seen;
}

/** By the simulated world's own log: no two bodies (10.5 m x 2.5 m) ever shared floor. */
function assertApart(system, ids) {
  const logs = ids.map((id) => system.truth(id));
  const times = logs.map((log) => log.map((line) => line.t_ms));
  const at = (v, t) => { const k = times[v].findLastIndex((time) => time <= t); return logs[v][Math.max(0, k)]; };
  for (let a = 0; a < ids.length; a++) for (const [k, line] of logs[a].entries()) for (let b = 0; b < a; b++) {
    const other = at(b, times[a][k]);
    if (other) assert.ok(!overlap(line, other), `${ids[a]} and ${ids[b]} on the same floor at ${times[a][k]}: ${JSON.stringify([line, other])}`);
  }
}

/** Separating axes of two rectangles, a little smaller than the bodies: the log is 20 Hz and vehicles drive 16 m/s. */
function overlap(p, q, length = 9.5, width = 2.3) {
  const axes = [p, q].flatMap(({ heading_rad: h }) => [[Math.cos(h), Math.sin(h)], [-Math.sin(h), Math.cos(h)]]);
  const reach = ({ heading_rad: h }, [x, y]) => (length / 2) * Math.abs(Math.cos(h) * x + Math.sin(h) * y) + (width / 2) * Math.abs(-Math.sin(h) * x + Math.cos(h) * y);
  return axes.every((axis) => Math.abs((p.x_m - q.x_m) * axis[0] + (p.y_m - q.y_m) * axis[1]) < reach(p, axis) + reach(q, axis));
}

/** Until all have ended, each stop found by the vehicle's own senses. */
const ended = async (client, orders) => {
  for (const { id } of orders) {
    const order = await client.untilOrder(id, (o) => ["Ended", "Aborted", "Interrupted"].includes(o.state), "ended", 120);
    assert.equal(order.state, "Ended", JSON.stringify(order.reason));
  }
};

test("head on in a corridor: both get to the other's place by the bay", async (t) => {
  const plant = { spots: { west: [20, 40, 1], east: [70, 40, 2], middle: [45, 40], bay: [45, 62, 3] }, lanes: ["west-middle", "middle-east", "middle-bay"], vehicles: [1, 2] };
  const seen = await meeting(t, plant, async ({ system, client }) => {
    await ended(client, [await client.order("V1", [2]), await client.order("V2", [1])]);
  });
  assert.ok(seen.size > 0, "nobody was seen waiting");
});

test("four in a ring over a crossing: each takes the next one's place", async (t) => {
  const plant = {
    spots: { west: [20, 60, 1], north: [45, 85, 2], east: [70, 60, 3], south: [45, 35, 4], crossing: [45, 60], bay: [66, 81, 5] },
    lanes: ["west-crossing", "north-crossing", "east-crossing", "south-crossing", "crossing-bay"], vehicles: [1, 2, 3, 4],
    obstacles: [[24, 68, 36, 80], [24, 40, 36, 52], [54, 40, 66, 52]], // no way but over the crossing
  };
  const seen = await meeting(t, plant, async ({ system, client }) => {
    const orders = [];
    for (const i of [1, 2, 3, 4]) orders.push(await client.order(`V${i}`, [{ station: (i % 4) + 1, motion_mode: "linear" }]));
    await ended(client, orders);
  });
  assert.ok(seen.size > 1, `only seen: ${[...seen]}`);
});

test("an idle platform backs out of a dead end for another", async (t) => {
  const plant = { spots: { west: [20, 40, 1], junction: [45, 40], end: [45, 65, 2], east: [70, 40, 3] }, lanes: ["west-junction", "junction-end", "junction-east"], vehicles: [1, 2] };
  await meeting(t, plant, async ({ system, client }) => {
    await ended(client, [await client.order("V1", [2])]);
    const way = (await client.events()).filter((event) => event.type === "vehicle.makes_way");
    assert.deepEqual(way.map((event) => event.vehicle), ["V2"]);
    const { at_station: at } = await client.get("/api/v1/vehicles/V2");
    assert.ok(at !== 2, `V2 still stands at ${at}`);
  });
});

test("a breakdown on the only road is waited for by name, and ends when it is mended", async (t) => {
  const plant = { spots: { west: [20, 40, 1], middle: [45, 40, 2], east: [70, 40, 3], far: [95, 40, 4] }, lanes: ["west-middle", "middle-east", "east-far"], vehicles: [1, 2] };
  await meeting(t, plant, async ({ system, client }) => {
    await client.untilVehicle("V2", (v) => v.reason?.code === "wheel_fault", "is broken down");
    const order = await client.order("V1", [3]);
    const waits = await client.untilOrder(order.id, (o) => o.reason?.code === "floor_held", "waits");
    assert.ok(JSON.stringify(waits.reason.params).includes("V2"), JSON.stringify(waits.reason));

    await system.kill(system.agents.get("V2"));
    system.startAgent("V2", { seed: 2, sensing: "analytic" });
    await until("V2 mended", async () => {
      const v = await client.get("/api/v1/vehicles/V2");
      if (v.needs_resume) await client.post("/api/v1/fleet/resume", { vehicles: ["V2"] });
      return v.pose_known && v.reason?.code !== "wheel_fault";
    });
    await ended(client, [order]);
  }, { V2: { extra: ["--fault", "wheel=FL@0.5"] } });
});
