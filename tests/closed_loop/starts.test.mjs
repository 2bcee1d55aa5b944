// Vehicles that are switched on somewhere: half of them near a station, half anywhere on the floor. Each finds itself by what
// it sees or asks a person, who points at it 0.1 m and 5 deg off; what it then says of its place holds. Truth judges.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { Client, angleBetween } from "../harness/client.mjs";
import { ROOT, System, until } from "../harness/processes.mjs";
import { pick, randomOf } from "../harness/random.mjs";

const ROUNDS = Number(process.env.PULSELINE_STARTS ?? 2), FACTOR = 8, LOOKS_S = 30, DEG = Math.PI / 180;
const PERSON_M = 0.1, PERSON_DEG = 5, FOUND_DEG = 0.5;
const CELLS = { origin: -0.1, resolution: 0.1 }; // final-assembly.yaml

const wayBetween = (a, b) => Math.hypot(a.x_m - b.x_m, a.y_m - b.y_m);

function awayFromEdge(at, outline) {
  return Math.min(...outline.map((a, i) => {
    const b = outline[(i + 1) % outline.length], dx = b.x_m - a.x_m, dy = b.y_m - a.y_m;
    const share = Math.min(1, Math.max(0, ((at.x_m - a.x_m) * dx + (at.y_m - a.y_m) * dy) / (dx * dx + dy * dy)));
    return Math.hypot(a.x_m + share * dx - at.x_m, a.y_m + share * dy - at.y_m);
  }));
}
function isInside(at, outline) {
  return outline.reduce((inside, a, i) => {
    const b = outline[(i + 1) % outline.length];
    return (a.y_m > at.y_m) !== (b.y_m > at.y_m) && at.x_m < a.x_m + ((at.y_m - a.y_m) / (b.y_m - a.y_m)) * (b.x_m - a.x_m) ? !inside : inside;
  }, false);
}

/** Middles of the cells in which the hall's grid has walls and columns. */
function standing(file) {
  const [, width, height] = /^P5\s+(\d+)\s+(\d+)\s+255\s/.exec(readFileSync(file, "latin1"));
  const cells = readFileSync(file).subarray(-width * height), { origin, resolution } = CELLS;
  return [...cells].flatMap((value, i) => (value > 0 ? [] : [{ x_m: origin + ((i % width) + 0.5) * resolution, y_m: origin + (height - 0.5 - Math.floor(i / width)) * resolution }]));
}

/** Places for all, with room for each body however it is turned. */
function starts(model, random) {
  const [hall] = model.halls, taken = [], columns = standing(join(ROOT, "db/plants/final-assembly.pgm"));
  const width = Math.max(...hall.outline.map(({ x_m }) => x_m)), depth = Math.max(...hall.outline.map(({ y_m }) => y_m));
  const radius = ({ type }) => {
    const { footprint, load_footprint } = model.vehicle_types.find(({ id }) => id === type);
    return Math.max(...[...footprint, ...(load_footprint ?? [])].map(({ x_m, y_m }) => Math.hypot(x_m, y_m)));
  };
  const isFree = (at, r) => isInside(at, hall.outline) && awayFromEdge(at, hall.outline) > r
    && columns.every((cell) => wayBetween(at, cell) > r)
    && model.areas.filter(({ kind }) => kind === "obstacle" || kind === "no_go").every(({ outline }) => !isInside(at, outline) && awayFromEdge(at, outline) > r)
    && taken.every((other) => wayBetween(at, other) > r + other.r);
  const anywhere = () => ({ x_m: random() * width, y_m: random() * depth, heading_rad: (2 * random() - 1) * Math.PI });
  const nearAStation = (vehicle) => {
    const own = model.stations.filter(({ vehicle_types }) => !vehicle_types?.length || vehicle_types.includes(vehicle.type));
    const { pose } = pick(random, own), off = () => (2 * random() - 1) * 0.15;
    return { x_m: pose.x_m + off(), y_m: pose.y_m + off(), heading_rad: pose.heading_rad + off() };
  };
  // The largest first: the others find a place beside them.
  return [...model.vehicles].sort((a, b) => radius(b) - radius(a)).map((vehicle, i) => {
    const r = radius(vehicle) + 0.3, near = i % 2 === 0;
    for (let tries = 0; tries < 1000; ++tries) {
      const at = near && tries < 200 ? nearAStation(vehicle) : anywhere();
      if (!isFree(at, r)) continue;
      taken.push({ ...at, r });
      return { vehicle, at };
    }
    throw new Error(`no room for ${vehicle.id}`);
  });
}

const done = { itself: 0, asked: 0, found: 0, byWalls: 0, families: new Map() };

/** What it says of its place, against where it is: three sigma. */
function holds(said, truth) {
  assert.equal(said.claimed_pose, undefined, `${said.id} says that it stands where it cannot`);
  const off_m = wayBetween(said.pose, truth);
  assert.ok(off_m <= said.pose_deviation_m, `${said.id} is ${off_m} m off and holds it for ${said.pose_deviation_m} m at most, by ${said.navigation?.by}; truth ${JSON.stringify(truth)}`);
}

/** Found: its heading, too, of which it says no sigma. */
function isTurnedRight(said, truth) {
  const off_deg = Math.abs(angleBetween(said.pose.heading_rad, truth.heading_rad)) / DEG;
  assert.ok(off_deg < FOUND_DEG, `${said.id} holds itself to be turned ${off_deg} deg otherwise, by ${said.navigation?.by}`);
}

for (let round = 1; round <= ROUNDS; ++round) {
  test(`twelve vehicles switched on somewhere, round ${round}: each finds itself or asks, and knows how well it knows`, async (t) => {
    const system = await System.create("final-assembly");
    t.after(() => system.stop());
    const random = randomOf(round);
    const all = starts(system.plant.model, random);
    system.prepareVehicles(all.map(({ vehicle }) => vehicle.id));
    await system.startServer();
    const client = new Client(system.url, system.apiToken);
    for (const [i, { vehicle, at }] of all.entries()) {
      const line = { t_ms: Date.now(), vehicle: vehicle.id, ...at, moving: false, order_id: "", last_node_seq: 0, base_end_seq: 0 };
      writeFileSync(`${system.truthLog}.${vehicle.id}`, `${JSON.stringify(line)}\n`);
      system.startAgent(vehicle.id, { seed: 100 * round + i, timeFactor: FACTOR, sensing: "analytic", extra: ["--drive", "servo", "--maps", "db/maps/final-assembly"] });
    }
    const lookedAround = (since_ms) => Date.now() - since_ms > LOOKS_S / FACTOR * 1e3;
    const begun_ms = Date.now(), told = [];
    for (const { vehicle: { id, type }, at } of all) {
      if (!done.families.has(type)) done.families.set(type, new Set());
      const how = done.families.get(type);
      const first = await client.untilVehicle(id, (v) => v.link === "live" && (v.pose_known || (v.reason?.code === "pose_unknown" && lookedAround(begun_ms))), "finds itself or asks");
      if (first.pose_known) {
        holds(first, at);
        isTurnedRight(first, at);
        ++done.itself;
        how.add("itself");
        continue;
      }
      ++done.asked;
      how.add("asked");
      const away = random() * 2 * Math.PI, turned = (random() < 0.5 ? 1 : -1) * PERSON_DEG * DEG;
      await client.post(`/api/v1/vehicles/${id}/init-position`, { x_m: at.x_m + PERSON_M * Math.cos(away), y_m: at.y_m + PERSON_M * Math.sin(away), heading_rad: at.heading_rad + turned });
      await client.untilVehicle(id, (v) => v.pose_known, "knows what it was told");
      told.push({ id, at });
    }
    const told_ms = Date.now();
    await until("all to look around", () => lookedAround(told_ms));
    for (const { id, at } of told) {
      const said = await client.get(`/api/v1/vehicles/${id}`);
      if (!said.pose_known) continue; // what it sees is not what a map has there: it asks again
      holds(said, at);
      if (said.navigation?.by === "person" || said.pose_deviation_m >= PERSON_M) continue;
      isTurnedRight(said, at);
      ++done.found;
      if (said.navigation?.by !== "contours") continue;
      ++done.byWalls;
      done.families.get(system.plant.vehicle(id).type).add("by the walls");
    }
  });
}

test("of them some found themselves, the others asked, and for nine in ten of these a person's place was enough", () => {
  console.log(`# ${JSON.stringify({ ...done, families: Object.fromEntries([...done.families].map(([type, how]) => [type, [...how]])) })}`);
  assert.ok(done.itself > 0 && done.asked > 0 && done.byWalls > 0, JSON.stringify(done));
  // Anywhere, others may stand before the walls on all sides.
  assert.ok(done.found >= 0.9 * done.asked, `a person's place was enough: ${done.found} of ${done.asked}`);
  assert.equal(done.itself + done.asked, 12 * ROUNDS);
  assert.equal(done.families.size, 4, "a start of each family");
});
