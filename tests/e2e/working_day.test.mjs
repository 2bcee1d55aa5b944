// The working day of Tang's platform (2020, section 2, workflow a to c) by clicks and keys in Chromium: driven by hand below the
// aircraft that hangs at station 0, it takes it over, stands on its feet at stations 1 to 6, has its height adjusted by 50 mm at 3,
// and sets it down at 7. Real server, real program, machine and pictures over TCP; who drives by hand sees where it truly is.
// The same by REST is tests/closed_loop/working_day.test.mjs.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { decide, picture, signedIn, startBrowser } from "../harness/browser.mjs";
import { Client, angleBetween } from "../harness/client.mjs";
import { morning } from "../harness/plants.mjs";
import { System, until } from "../harness/processes.mjs";

const kId = "TP-01", kLoad = "A-101", kWeight_N = 18200 * 9.80665, MM = 1e-3, DEG = Math.PI / 180;
let system, client, browser, page;

before(async () => {
  system = await System.create(morning(0));
  system.prepareVehicles([kId]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  await system.startOverTcp(kId, { seed: 22, timeFactor: 6 });
  await client.untilReady(kId);
  browser = await startBrowser();
  page = await signedIn(browser, system, "operator", { path: `/vehicles/${kId}` });
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

const newest = async () => (await client.get(`/api/v1/job-orders?vehicle=${kId}`)).items[0];
const stopsInside = async (order) => (await client.stops(order)).filter((stop) => stop.inside).map((stop) => stop.number);
const inRail = (name) => page.locator("nav").getByRole("link", { name, exact: true });

/** Where the vehicle has to go from where it is, as one sees it who walks beside it. */
function wayTo({ pose }) {
  const truth = system.lastTruth(kId), [dx, dy] = [pose.x_m - truth.x_m, pose.y_m - truth.y_m];
  const [c, s] = [Math.cos(truth.heading_rad), Math.sin(truth.heading_rad)];
  return { ahead: c * dx + s * dy, aside: c * dy - s * dx, turn: angleBetween(pose.heading_rad, truth.heading_rad) };
}

const kKeys = { ahead: ["ArrowUp", "ArrowDown"], aside: ["ArrowLeft", "ArrowRight"], turn: ["KeyQ", "KeyE"] };
/** From so far on at which speed: creeping at the end. */
const kSpeeds = { ahead: [0.6, 0.15], aside: [0.6, 0.15], turn: [12 * DEG, 2.5 * DEG] };

/** Holds, and presses the key that brings it nearer, until it is as near as that or past it. */
async function byKeys(name, way, near) {
  for (let speed = 0; speed < 3; ++speed) {
    const least = kSpeeds[name][speed] ?? near;
    const left = way();
    if (Math.abs(left) <= least) continue;
    await page.keyboard.press(`Digit${3 - speed}`);
    const key = kKeys[name][left > 0 ? 0 : 1];
    await page.keyboard.down("Space");
    await page.keyboard.down(key);
    await until(`${name} near enough`, () => { const now = way(); return Math.abs(now) <= least || now * left < 0; }, { timeout_s: 60, every_ms: 5 });
    await page.keyboard.up("Space");
    await page.keyboard.up(key);
    await page.locator(".desk .says", { hasText: "It stands" }).waitFor();
    await until("it stands", () => system.lastTruth(kId).moving === false);
  }
}

test("driven by hand below the aircraft at station 0, given back, and sent onto the mark", async () => {
  await page.getByRole("link", { name: "Drive by hand" }).click();
  await page.locator(".nextsteps .cmd", { hasText: "Take it in hand" }).click();
  await page.locator(".desk[data-mine=true]").waitFor();
  const there = system.plant.station(0);
  for (let round = 0; round < 5; ++round) {
    await byKeys("turn", () => wayTo(there).turn, 0.15 * DEG);
    await byKeys("ahead", () => wayTo(there).ahead, 15 * MM);
    await byKeys("aside", () => wayTo(there).aside, 15 * MM);
    const { ahead, aside, turn } = wayTo(there);
    if (Math.hypot(ahead, aside) <= 30 * MM && Math.abs(turn) <= 0.3 * DEG) break;
  }
  await page.locator(".nextsteps .codes .chip", { hasText: "mm off" }).nth(1).waitFor(); // both cameras see their codes
  await page.locator(".target h2", { hasText: "To station 0" }).waitFor();
  await picture(page, "working-day-below");
  await page.locator(".nextsteps .cmd", { hasText: "Give it back" }).click();
  await decide(page, page.locator(".nextsteps .held .cmd", { hasText: "Resume" }));
  await page.getByRole("link", { name: "Send it" }).click();
  await page.locator(".pad").getByRole("button", { name: "0", exact: true }).click();
  const start = page.getByRole("button", { name: /Start move/ });
  await until("start can be armed", async () => (await start.count()) > 0 && (await start.getAttribute("aria-disabled")) !== "true", { timeout_s: 30, every_ms: 100 });
  await page.getByRole("button", { name: /Arm/ }).click();
  await page.getByText(/[1-7] s left/).waitFor();
  await start.click();
  const order = await until("the order is stored", newest, { timeout_s: 10, every_ms: 50 });
  assert.equal((await client.untilEnded(order.id)).state, "Ended");
  const stop = (await client.stops(order.id)).at(-1);
  assert.ok(stop.inside, JSON.stringify(stop));
  assert.equal(stop.load, undefined);
});

/** Writes a tour with the number pad, each station with the buttons pressed for it, and starts it. */
async function tour(stations) {
  const last = (await newest())?.id;
  await inRail("Orders").click();
  await page.getByRole("button", { name: "New order" }).click();
  const form = page.locator(".tour");
  await form.getByRole("button", { name: "Any that can" }).waitFor();
  await form.getByRole("button", { name: kId, exact: true }).click();
  for (const [i, [number, ...acts]] of stations.entries()) {
    if (i > 0) await form.getByRole("button", { name: "Add station" }).click();
    await form.locator(".pad").getByRole("button", { name: String(number), exact: true }).click();
    const row = form.locator(".tourlist > li").nth(i);
    for (const act of acts) {
      const button = row.getByRole("button", { name: act });
      await button.waitFor();
      if ((await button.getAttribute("aria-pressed")) !== "true") await button.click();
    }
  }
  await form.getByText(/^About [\d:]+ min in all$/).waitFor({ timeout: 30_000 });
  await decide(page, form.locator("button.cmd"));
  await page.waitForURL(/\/orders\/[0-9a-f-]{36}/);
  return until("the order is stored", async () => { const found = await newest(); return found.id !== last && found; }, { timeout_s: 10, every_ms: 50 });
}

test("it takes 18.2 t over and stands on its feet at stations 1, 2 and 3", async () => {
  const order = await tour([[0, `Take over ${kLoad}`], [1, "Stand on feet"], [2, "Stand on feet"], [3, "Stand on feet"]]);
  const carrying = await client.untilVehicle(kId, (v) => v.load === kLoad, "carries it", 90);
  const force_N = carrying.brackets.reduce((sum, b) => sum + b.force_a_n + b.force_b_n, 0);
  assert.ok(Math.abs(force_N - kWeight_N) < 0.03 * kWeight_N, `${force_N} N`);
  const ended = await client.untilEnded(order.id, 300);
  assert.equal(ended.state, "Ended", JSON.stringify(ended.reason));
  assert.deepEqual((await stopsInside(order.id)).filter((number) => number > 0), [1, 2, 3]);
  const parked = await client.get(`/api/v1/vehicles/${kId}`);
  assert.ok(parked.parking_feet.every((foot) => foot.force_n > 10_000), "on its feet");
});

test("people at station 3 have the aircraft raised by 50 mm", async () => {
  const before_m = (await client.get(`/api/v1/vehicles/${kId}`)).brackets[0].height_m;
  await inRail("Vehicles").click();
  await page.getByRole("link", { name: kId }).first().click();
  const card = page.locator(".lifts");
  if (!(await card.evaluate((e) => e.open))) await card.locator("summary").click();
  await page.getByLabel("Height, mm").fill(String(Math.round(before_m / MM) + 50));
  await decide(page, card.locator(".fields .cmd"));
  const raised = await client.untilVehicle(kId, (v) => v.lift?.type === "setBracketHeight" && v.lift.state === "done", "is raised", 90);
  raised.brackets.forEach((bracket) => assert.ok(Math.abs(bracket.height_m - before_m - 50 * MM) <= 1 * MM, `${bracket.name}: ${bracket.height_m} m`));
  assert.equal(raised.load, kLoad);
  await picture(page, "working-day-raised");
});

test("by stations 4, 5 and 6 it comes to 7 and sets the aircraft down", async () => {
  const order = await tour([[4, "Stand on feet"], [5, "Stand on feet"], [6, "Stand on feet"], [7, "Set down"]]);
  const ended = await client.untilEnded(order.id, 400);
  assert.equal(ended.state, "Ended", JSON.stringify(ended.reason));
  assert.deepEqual(await stopsInside(order.id), [4, 5, 6, 7]);
  assert.equal((await client.get(`/api/v1/loads/${kLoad}`)).station, 7);
  const empty = await client.get(`/api/v1/vehicles/${kId}`);
  assert.deepEqual([empty.load, empty.load_fault], [undefined, undefined]);
  const moved = (await client.events()).filter(({ type }) => type === "load.moved").map(({ params }) => params);
  assert.deepEqual(moved, [{ load: kLoad, from_station: 0, to_vehicle: kId }, { load: kLoad, from_vehicle: kId, to_station: 7 }]);
  await page.locator(".odetail [role=status]", { hasText: "Done" }).waitFor();
  await picture(page, "working-day-done");
  assert.deepEqual(page.errors, []);
});
