// A vehicle whose cameras have a program of their own: its pictures are files that are replaced all the time, and its controller
// takes none. The controller's log judges. When the files stand still the vehicle says so and measures nothing by an old picture.
import assert from "node:assert/strict";
import { mkdirSync, rmdirSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Client, angleBetween } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";

const kId = "TP-01", kCameras = ["front", "back"];
let system, client, pictures;

before(async () => {
  system = await System.create("pulse-line");
  system.prepareVehicles([kId]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  pictures = join(system.directory, "pictures");
  await system.startOverTcp(kId, { seed: 7, timeFactor: 2, pictures, extra: kCameras.flatMap((name) => ["--camera", `${name}=file:${join(pictures, `${name}.pgm`)}`]) });
  await client.untilReady(kId);
});
after(() => system?.stop());

const beside = (name) => join(pictures, `${name}.pgm.new`); // where the next picture is written; nothing can be while a folder is there

test("it drives over stations by its picture files and stands where its stops say", async () => {
  const order = await client.order(kId, [2, 3]);
  assert.equal((await client.untilEnded(order.id, 240)).state, "Ended");
  const stops = await client.stops(order.id);
  const last = stops.at(-1), { pose } = system.plant.station(3), { x_m, y_m, heading_rad } = system.lastTruth(kId);
  assert.ok(last.inside && last.method === "dual_camera", JSON.stringify(last));
  assert.ok(Math.hypot(last.dx_m - (x_m - pose.x_m), last.dy_m - (y_m - pose.y_m)) < 1e-3, `${JSON.stringify(last)} at ${x_m}, ${y_m}`);
  assert.ok(Math.abs(angleBetween(last.dheading_rad, heading_rad - pose.heading_rad)) < 2e-4);
});

test("its pictures stand still: the next stop is not measured and says why, and is once they go on", async () => {
  const order = await client.order(kId, [4]);
  await until("it drives", () => system.lastTruth(kId).moving, { timeout_s: 60 });
  kCameras.forEach((name) => mkdirSync(beside(name)));
  const asks = await client.untilOrder(order.id, (o) => ["Ended", "Aborted", "Interrupted"].includes(o.state), "asks", 240);
  assert.deepEqual([asks.state, asks.reason.code], ["Interrupted", "stop_not_measured"], JSON.stringify(asks.reason));
  assert.match(asks.reason.params.why, /camera_silent/);
  assert.match(system.log(`agent-${kId}`), /camera\.silent .*front/);
  kCameras.forEach((name) => rmdirSync(beside(name)));
  await client.untilVehicle(kId, (v) => v.cameras?.every((camera) => camera.why_not !== "camera_silent"), "sees again", 30);
});
