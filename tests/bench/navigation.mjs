// ./dev bench navigation: what it costs a vehicle to know where it is, each against what it may: a step of the filter, a look at
// the walls, a fix by iGPS and by reflectors, a code read under way, a route over free floor; and an agent with all its senses,
// of which twelve have to run in real time on two cores.   [SECONDS]
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Client } from "../harness/client.mjs";
import { BUILD, System } from "../harness/processes.mjs";

const SECONDS = Number(process.argv.slice(2).find((argument) => /^\d+$/.test(argument)) ?? 60);
const FOLDER = join(BUILD, "bench"), TICKS = 100; // of a second, as /proc counts
// All in milliseconds, but the last four. Cameras take 60 pictures a second, of codes that are driven over: half of them are read in a
// tenth of that time, and nearly all before the next one.
const FRAME_MS = 1000 / 60;
const LIMITS = {
  "step of the filter": 0.05, "fix by iGPS": 0.05, "look at the walls": 10, "look at the walls after a person's word": 10,
  ...Object.fromEntries(["QR", "AprilTag", "landmark"].flatMap((kind) => [[`code under way, ${kind}, p50`, FRAME_MS / 10], [`code under way, ${kind}, p99`, FRAME_MS]])),
  "route over free floor, final assembly, p99": 2, "route over free floor, measuring hall, p99": 2,
  "an agent, share of a core": 0.15, "an agent, MB": 300, "agents and server, cores": 2, "own time lost, share": 0.005,
};
mkdirSync(FOLDER, { recursive: true });
const run = (program, name, ...args) => {
  const file = join(FOLDER, `${name}.json`);
  execFileSync(join(BUILD, program), [`--benchmark_out=${file}`, "--benchmark_out_format=json", ...args], { stdio: ["ignore", "ignore", "inherit"] });
  return JSON.parse(readFileSync(file, "utf8"));
};
const figures = {};

const senses = run("bench_navigation", "navigation-senses").benchmarks;
const ms = (name) => { const { cpu_time, time_unit } = senses.find((one) => one.name === name); return cpu_time * { ns: 1e-6, us: 1e-3, ms: 1 }[time_unit]; };
figures["step of the filter"] = ms("filter_step");
figures["fix by iGPS"] = ms("igps_fix");
figures["look at the walls"] = ms("contours_look/0");
figures["look at the walls after a person's word"] = ms("contours_look/1");

for (const read of run("bench_vision", "navigation-codes", "--own", "driving", "1000")) {
  const kind = { qr: "QR", apriltag: "AprilTag", landmark: "landmark" }[read.kind];
  figures[`code under way, ${kind}, p50`] = read.methods["pulseline, expected"].ms_median;
  figures[`code under way, ${kind}, p99`] = read.methods["pulseline, expected"].ms_p99;
}
for (const leg of run("bench_planning", "navigation-routes", "--only", "legs", "--benchmark_filter=^floor_leg").benchmarks) {
  const hall = leg.name.includes("measuring") ? "measuring hall" : "final assembly";
  figures[`route over free floor, ${hall}, p99`] = leg.p99_us / 1e3;
}

/** Twelve with rendered images, on the way all the time. */
const system = await System.create("final-assembly");
const ids = system.plant.model.vehicles.map(({ id }) => id);
system.prepareVehicles(ids);
await system.startServer();
const client = new Client(system.url, system.apiToken);
ids.forEach((id, i) => system.startAgent(id, { seed: 100 + i, timeFactor: 1, extra: ["--maps", "db/maps/final-assembly"] }));
await Promise.all(ids.map((id) => client.untilReady(id, 120)));
const { vehicles, stations } = system.plant.model;
for (const { id, type } of vehicles) {
  const own = stations.filter(({ vehicle_types: of }) => !of?.length || of.includes(type)).map(({ number }) => number);
  const at = (await client.get(`/api/v1/vehicles/${id}`)).at_station;
  const steps = own.filter((number) => system.plant.station(number).id !== at);
  await client.request("POST", "/api/v1/job-orders", { body: { vehicle: id, steps: steps.slice(0, 4).map((station) => ({ station })) } });
}
const used_s = ({ pid }) => { const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" "); return (Number(fields[11]) + Number(fields[12])) / TICKS; };
const rss_mb = ({ pid }) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, "utf8"))[1]) / 1024;
const agents = ids.map((id) => system.agents.get(id));
// Not what twelve programs that begin at once lose before anything drives.
const lostTime_s = (id) => [...readFileSync(join(system.directory, `agent-${id}.log`), "utf8").matchAll(/time\.lost seconds="?([\d.]+)/g)].reduce((sum, [, seconds]) => sum + Number(seconds), 0);
const lost_before_s = ids.map(lostTime_s);
const before = agents.map(used_s), server_before = used_s(system.server), from = performance.now();
await new Promise((done) => setTimeout(done, SECONDS * 1e3));
const passed_s = (performance.now() - from) / 1e3;
const shares = agents.map((agent, i) => (used_s(agent) - before[i]) / passed_s);
const server_share = (used_s(system.server) - server_before) / passed_s;
figures["an agent, share of a core"] = shares.reduce((sum, share) => sum + share, 0) / shares.length;
figures["an agent, MB"] = Math.max(...agents.map(rss_mb));
figures["agents and server, cores"] = shares.reduce((sum, share) => sum + share, 0) + server_share;
await system.stop();
figures["own time lost, share"] = Math.max(...ids.map((id, i) => lostTime_s(id) - lost_before_s[i])) / passed_s;

writeFileSync(join(FOLDER, "navigation.json"), JSON.stringify({ date: new Date().toISOString(), seconds: SECONDS, limits: LIMITS, figures, agents: Object.fromEntries(ids.map((id, i) => [id, shares[i]])), server: server_share }, null, 2));
let good = true;
for (const [what, limit] of Object.entries(LIMITS)) {
  const kept = figures[what] <= limit;
  good &&= kept;
  console.log(`${what.padEnd(46)} ${figures[what]?.toPrecision(3).padStart(8)}  at most ${limit.toPrecision(3)}${kept ? "" : "  NO"}`);
}
console.log(`${ids.length} agents use ${shares.reduce((sum, share) => sum + share, 0).toFixed(2)} cores together, the server ${server_share.toFixed(2)}`);
process.exitCode = good ? 0 : 1;
