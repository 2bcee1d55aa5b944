// The twelve vehicles of the demo hall under random orders for hours of their own time: with the whole budget of errors, by their
// own senses, in one world in which they see each other. Every stop has to be measured and inside, nobody may lose itself or call
// a person, and what each believes has to hold.
// node tests/closed_loop/demo_hours.mjs [--hours 10] [--time-factor 10] [--seed 1] [--plant final-assembly] [--sensing analytic]
//   [--vehicles DL-01,DL-02]  only these are switched on
// Ended early by a signal, it judges the time that has passed.
import { parseArgs } from "node:util";
import { createReadStream, existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { Client } from "../harness/client.mjs";
import { ROOT, System } from "../harness/processes.mjs";
import { pick, randomOf } from "../harness/random.mjs";

const { values } = parseArgs({ options: {
  hours: { type: "string", default: "10" }, "time-factor": { type: "string", default: "10" }, seed: { type: "string", default: "1" },
  plant: { type: "string", default: "final-assembly" }, sensing: { type: "string", default: "analytic" }, errors: { type: "string", default: "nominal" }, vehicles: { type: "string" },
} });
const HOURS = Number(values.hours), FACTOR = Number(values["time-factor"]), SEED = Number(values.seed);
const OPEN_EACH = 2, MOST_STEPS = 4, CANCELLED_A_LOOK = 5e-4, PATIENCE_S = 1800; // of the vehicles' time, for an order
const random = randomOf(SEED);
const turn = (rad) => Math.atan2(Math.sin(rad), Math.cos(rad));
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

const system = await System.create(values.plant);
const { stations } = system.plant.model;
const vehicles = system.plant.model.vehicles.filter(({ id }) => values.vehicles === undefined || values.vehicles.split(",").includes(id));
const ids = vehicles.map((vehicle) => vehicle.id);
system.prepareVehicles(ids);
await system.startServer();
const client = new Client(system.url, system.apiToken);
const maps = existsSync(join(ROOT, "db/maps", values.plant)) ? ["--maps", join("db/maps", values.plant)] : [];
system.startAgents(ids, { seed: SEED, timeFactor: FACTOR, sensing: values.sensing, extra: ["--drive", "servo", "--errors", values.errors, ...maps] });
await Promise.all(ids.map((id) => client.untilReady(id, 120)));
const { last_event_seq: begun_seq } = await client.get("/api/v1/fleet");
const stationsOf = new Map(vehicles.map(({ id, type }) => [id, stations.filter((s) => !s.vehicle_types?.length || s.vehicle_types.includes(type)).map((s) => s.number)]));

const begun_ms = Date.now();
let counted = { at_ms: -Infinity, lost_s: 0 };
/** Of their own time; where their program did not keep up with the clock, none has passed. */
function passed_s() {
  if (Date.now() - counted.at_ms > 2e3) {
    const log = readFileSync(join(system.directory, "agents.log"), "utf8");
    counted = { at_ms: Date.now(), lost_s: [...log.matchAll(/time\.lost seconds="?([\d.]+)/g)].reduce((sum, [, seconds]) => sum + Number(seconds), 0) };
  }
  return ((Date.now() - begun_ms) / 1e3 - counted.lost_s) * FACTOR;
}

const open = new Map(); // order id -> { vehicle, since_s }
const faults = new Map(); // what went wrong -> how often
const bad = (what) => { if (!faults.has(what)) console.log(`${new Date().toISOString()} ${what}`); faults.set(what, (faults.get(what) ?? 0) + 1); };
const waiting = new Map(); // vehicle -> what it waits for a person for
let ended = 0, cancelled = 0;

async function order(vehicle) {
  let last;
  const steps = Array.from({ length: 1 + Math.floor(random() * MOST_STEPS) }, () => {
    do { var station = pick(random, stationsOf.get(vehicle)); } while (station === last);
    return (last = station);
  });
  const answer = await client.request("POST", "/api/v1/job-orders", { body: { vehicle, steps: steps.map((station) => ({ station })) } });
  if (answer.status >= 500) bad(`order for ${vehicle}: ${answer.status}`);
  if (answer.status < 300) open.set(answer.body.id, { vehicle, since_s: passed_s() });
}

async function look() {
  for (const [id, { vehicle, since_s }] of open) {
    const { state, reason } = await client.get(`/api/v1/job-orders/${id}`);
    if (state === "Ended" || state === "Aborted") {
      open.delete(id);
      if (state === "Ended") ++ended;
      else if (reason?.code === "cancelled_by_person") ++cancelled;
      else bad(`an order of ${vehicle} was aborted: ${reason?.code}`);
    } else if (random() < CANCELLED_A_LOOK) {
      await client.request("POST", `/api/v1/job-orders/${id}/cancel`);
    } else if (passed_s() - since_s > PATIENCE_S * OPEN_EACH) {
      bad(`an order of ${vehicle} takes longer than ${PATIENCE_S * OPEN_EACH} s: ${state} ${reason?.code ?? ""}`);
      open.get(id).since_s = passed_s();
    }
  }
  const { items } = await client.get("/api/v1/vehicles");
  for (const { id, needs_resume, pose_known, reason, errors, pose, navigation } of items.filter(({ id }) => ids.includes(id))) {
    const calls = needs_resume ? `needs a person: ${reason?.code}` : pose_known ? "" : `lost its pose: ${errors.map(({ type }) => type).join(" ")}`;
    if (calls && waiting.get(id) !== calls) {
      bad(`${id} ${calls}`);
      console.log(JSON.stringify({ id, pose, navigation, errors, others: items.map((other) => [other.id, other.pose?.x_m, other.pose?.y_m]) }));
    }
    waiting.set(id, calls);
  }
}

let stopped = false;
for (const signal of ["SIGINT", "SIGTERM"]) process.once(signal, () => (stopped = true));
for (let told_s = 0; !stopped && passed_s() < HOURS * 3600;) {
  for (const id of ids) if ([...open.values()].filter(({ vehicle }) => vehicle === id).length < OPEN_EACH) await order(id);
  await look();
  if (passed_s() - told_s > 600) { told_s = passed_s(); console.log(`${ended} orders ended in ${(told_s / 3600).toFixed(2)} of ${HOURS} h`); }
  await sleep(250);
}
const passed_h = passed_s() / 3600;

async function all(path) {
  const items = [];
  for (let cursor = ""; cursor !== undefined;) {
    const page = await client.get(`${path}?limit=200${cursor && `&cursor=${encodeURIComponent(cursor)}`}`);
    items.push(...page.items);
    cursor = page.next_cursor;
  }
  return items;
}
// What came and went between two looks.
for (const { type, vehicle, params } of await client.events(begun_seq)) {
  if (["vehicle.pose_lost", "vehicle.pose_jumped", "vehicle.needs_resume"].includes(type)) bad(`${type} of ${vehicle}: ${JSON.stringify(params)}`);
}
const stops = await all("/api/v1/stop-records");
const unmeasured = await all("/api/v1/unmeasured-stops");
const outside = stops.filter((stop) => !stop.inside && stops.every((other) => other.order !== stop.order || other.step !== stop.step || other.attempt <= stop.attempt));
for (const { params } of unmeasured) bad(`a stop was not measured: ${String(params?.why).split(":")[0]}`);
const searched = stops.filter((stop) => !stop.arrival && stop.attempt === 1).length;
const off = stops.flatMap(({ arrival }) => (arrival ? [Math.hypot(arrival.dx_m, arrival.dy_m) * 1e3] : [])).sort((a, b) => a - b);
const at = (share) => off[Math.floor(share * (off.length - 1))]?.toFixed(1);
console.log(`${passed_h.toFixed(2)} h of ${ids.length} vehicles' time, seed ${SEED}: ${ended} orders ended, ${cancelled} cancelled; ${stops.length} stops measured, ${unmeasured.length} not, ${outside.length} outside at last; `
  + `drives ended ${at(0.5)} mm off in the middle, ${at(0.95)} mm at 95 %, ${at(1)} mm at most; ${searched} first approaches without a look at where the drive had ended`);

// What each believed on its way, beside where it truly was: no point of it may have been off by more than is held around it.
const HELD_M = 0.1;
const BEYOND = { place: 0.03, heading: 0.02 }; // shares beyond three of the stated sigma: what drives share is seen many times over
const nothing = () => ({ lines: 0, place: 0, heading: 0, most_m: 0 });
const beyond = nothing(), beyondOf = new Map(vehicles.map(({ type }) => [type, nothing()]));
const typeOf = new Map(vehicles.map(({ id, type }) => [id, type]));
const radius_m = new Map(vehicles.map(({ id, type }) => [id, Math.max(...system.plant.model.vehicle_types.find((one) => one.id === type).footprint.map(({ x_m, y_m }) => Math.hypot(x_m, y_m)))]));
for await (const line of createInterface({ input: createReadStream(system.truthLog) })) {
  if (!line.endsWith("}")) continue; // cut off where the program was
  const { vehicle, x_m, y_m, heading_rad, believed, moving, order_id } = JSON.parse(line);
  if (!moving || order_id === "") continue;
  const off_m = Math.hypot(x_m - believed.x_m, y_m - believed.y_m);
  const turned_rad = Math.abs(turn(heading_rad - believed.heading_rad));
  const most_m = off_m + radius_m.get(vehicle) * turned_rad;
  for (const sum of [beyond, beyondOf.get(typeOf.get(vehicle))]) {
    ++sum.lines;
    sum.place += off_m > 3 * believed.sigma_m;
    sum.heading += turned_rad > 3 * believed.sigma_rad;
    sum.most_m = Math.max(sum.most_m, most_m);
  }
  if (most_m > HELD_M) bad(`${vehicle} drove more than ${1e3 * HELD_M} mm from where it believed to be`);
}
for (const kind of ["place", "heading"]) if (beyond[kind] > BEYOND[kind] * beyond.lines) bad(`${kind} lies beyond three of its sigma too often`);
for (const [type, { lines, place, heading, most_m }] of [["on their way", beyond], ...beyondOf]) {
  const share = (count) => `${((100 * count) / lines).toFixed(2)} %`;
  console.log(`  ${type}: ${(1e3 * most_m).toFixed(1)} mm at most between where a point of a vehicle was and was believed; beyond three of its sigma: ${share(place)} in place, ${share(heading)} in heading`);
}
for (const [what, count] of faults) console.log(`  ${count} x ${what}`);
await system.stop();
const good = faults.size === 0 && outside.length === 0 && ended > 0;
console.log(good ? "1 passed, 0 failed" : "0 passed, 1 failed");
process.exit(good ? 0 : 1);
