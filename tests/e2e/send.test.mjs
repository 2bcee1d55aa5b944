// The operator's main job in Chromium against the real server and four real agents: sign in, send a platform,
// see it arrive, read how far from the drawing it stopped. The world's own log is the judge.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { Client, angleBetween } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";
import { picture, signedIn, startBrowser } from "../harness/browser.mjs";

const VEHICLES = ["TP-01", "TP-02", "TP-03", "MV-01"];
let system, client, browser;

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles(VEHICLES);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  VEHICLES.forEach((id, i) => system.startAgent(id, { seed: 11 + i }));
  for (const id of VEHICLES) await client.untilReady(id);
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

/** Fills in the send screen; the preview of the chosen mode must be there. */
async function choose(page, vehicle, station, mode) {
  await page.goto(`${system.url}/send`);
  const change = page.getByRole("button", { name: /^Change: Vehicle/ });
  if (await change.isVisible().catch(() => false)) await change.click();
  await page.getByRole("option", { name: new RegExp(`^${vehicle}`) }).click();
  for (const digit of String(station)) await page.getByRole("button", { name: digit, exact: true }).click();
  const row = page.getByRole("radio", { name: mode });
  await row.waitFor({ timeout: 20_000 });
  await row.click();
}

/** Two steps: arm, then start. Gives the newest order of the vehicle. */
async function armAndStart(page, vehicle) {
  const before = new Set((await client.get(`/api/v1/job-orders?vehicle=${vehicle}`)).items.map((o) => o.id));
  const start = page.getByRole("button", { name: /Start move/ });
  await until("start can be armed", async () => (await start.getAttribute("aria-disabled")) !== "true", { timeout_s: 20, every_ms: 100 });
  await page.getByRole("button", { name: /Arm/ }).click();
  // A press right behind the arming one is ignored by design; the ring has drained a second then.
  await page.getByText(/[1-7] s left/).waitFor();
  await page.getByRole("button", { name: /Start move/ }).dblclick();
  return until("the order is stored", async () => (await client.get(`/api/v1/job-orders?vehicle=${vehicle}`)).items.find((o) => !before.has(o.id)), { timeout_s: 10, every_ms: 50 });
}

async function checkArrival(vehicle, order, number) {
  assert.equal((await client.untilEnded(order.id, 90)).state, "Ended");
  const truth = system.lastTruth(vehicle);
  const { pose } = system.plant.station(number);
  assert.ok(Math.abs(truth.x_m - pose.x_m) <= 0.025 && Math.abs(truth.y_m - pose.y_m) <= 0.025, "inside +-25 mm by the truth");
  assert.ok(Math.abs(angleBetween(truth.heading_rad, pose.heading_rad)) <= 0.2 * Math.PI / 180, "inside +-0.2 deg by the truth");
}

test("sign in and see the hall", async () => {
  const page = await signedIn(browser, system, "operator");
  await page.locator("canvas").first().waitFor();
  await page.getByText("TP-01").first().waitFor();
  assert.deepEqual(page.errors, []);
  await picture(page, "map-1920-light-en");
  await page.context().close();
});

test("a wrong password is told in words", async () => {
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.goto(system.url);
  await page.locator("input[name=username]").fill("operator");
  await page.locator("input[type=password]").fill("wrong-password");
  await page.locator("button[type=submit]").click();
  await page.getByRole("alert").first().waitFor({ timeout: 10_000 });
  assert.equal(await page.locator(".shell").count(), 0);
  await context.close();
});

const reliesOn = [];
for (const [vehicle, station] of [["TP-01", 2], ["MV-01", 13], ["MV-01", 20]]) {
  test(`${vehicle} to station ${station}: the area of every mode that leads there, the others greyed with the reason`, async () => {
    const { options } = await client.post("/api/v1/motion-previews", { vehicle, station });
    const feasible = options.filter((o) => o.feasible).map((o) => o.mode);
    const suggested = options.find((o) => o.suggested).mode;
    const page = await signedIn(browser, system, "operator", { path: "/send" });
    await page.goto(`${system.url}/send?vehicle=${vehicle}&station=${station}`);
    const rows = page.locator(".mode[role=radio]");
    await rows.first().waitFor({ timeout: 20_000 });

    const map = page.locator(".pmap");
    await until("the areas are drawn", async () => (await map.getAttribute("data-areas")) !== "", { timeout_s: 10, every_ms: 50 });
    assert.deepEqual((await map.getAttribute("data-areas")).split(" ").sort(), [...feasible].sort(), "an area of each, and of no other");
    assert.equal(await map.getAttribute("data-chosen"), suggested, "the suggested one is hatched");
    assert.equal(await page.locator(".areas li[data-mode]").count(), feasible.length > 1 ? feasible.length : 0);
    const codes = options.find((o) => o.suggested).marker_chain?.markers.length ?? 0;
    assert.equal(await page.locator(`.areas li[data-chain="${codes}"]`).count(), codes > 0 ? 1 : 0, "how many codes it relies on");
    reliesOn.push(codes);
    for (const option of options) {
      const row = page.locator(`.mode[data-mode=${option.mode}]`);
      assert.equal(await row.getAttribute("aria-disabled"), String(!option.feasible), option.mode);
      assert.ok((await row.boundingBox()).height >= 44, `${option.mode}: high enough for gloves`);
      const words = await row.innerText();
      if (option.feasible) assert.match(words, /clear.*(usual for its kind|expected) ±[\d.]+ mm, ±[\d.]+°/s, option.mode);
      else assert.ok(words.length > 20 && !words.includes(option.reason.code) && !words.includes("Reason"), `${option.mode}: ${words}`);
    }

    // A refused mode can be read by keyboard, and is not chosen; a feasible one looked at stands out.
    await page.locator(`.mode[data-mode=${suggested}]`).focus();
    const seen = new Set();
    for (let i = 0; i < options.length; ++i) {
      await page.keyboard.press("ArrowDown");
      const { mode } = await page.evaluate(() => ({ ...document.activeElement.dataset }));
      seen.add(mode);
      if (!feasible.includes(mode)) await page.keyboard.press("Enter");
      else if (mode !== suggested) assert.equal(await map.getAttribute("data-looked"), mode);
    }
    assert.deepEqual([...seen].sort(), options.map((o) => o.mode).sort());
    assert.equal(await page.locator(".mode[aria-checked=true]").getAttribute("data-mode"), suggested);
    assert.deepEqual(page.errors, []);
    await picture(page, `send-modes-${vehicle}-${station}`);
    await page.context().close();
  });
}

test("one of these ways relies on codes, so that their number was shown", () => assert.ok(reliesOn.some((codes) => codes > 0), reliesOn.join()));

test("send TP-01 from station 1 to 2, linear: one order, an arrival, a visible stop record", async () => {
  const page = await signedIn(browser, system, "operator");
  await choose(page, "TP-01", 2, /Linear/);
  await picture(page, "send-1920-light-en");
  const order = await armAndStart(page, "TP-01");
  assert.equal((await client.get("/api/v1/job-orders?vehicle=TP-01")).items.length, 1, "a double click is one command");
  await checkArrival("TP-01", order, 2);
  await page.getByText(/Inside tolerance/).first().waitFor({ timeout: 15_000 });
  await picture(page, "arrival-1920-light-en");
  await page.getByRole("link", { name: /Stop record/ }).first().click();
  await page.waitForURL(/\/records\//);
  await page.getByText(/Inside tolerance/).first().waitFor();
  await picture(page, "record-1920-light-en");
  assert.deepEqual(page.errors, []);
  await page.context().close();
});

test("send TP-01 from station 3 to 4 by fixed-axis rotation", async () => {
  const there = await client.order("TP-01", [3]);
  await checkArrival("TP-01", there, 3);
  const page = await signedIn(browser, system, "operator");
  await choose(page, "TP-01", 4, /Fixed-axis/);
  const order = await armAndStart(page, "TP-01");
  await checkArrival("TP-01", order, 4);
  assert.equal((await client.stops(order.id)).at(-1).mode, "fixed_axis_rotation");
  await page.context().close();
});

test("Pause fleet is one press and Resume names the vehicles", async () => {
  const page = await signedIn(browser, system, "operator");
  await page.locator("button.pause", { hasText: "Pause fleet" }).click();
  await until("the fleet is paused", async () => (await client.get("/api/v1/fleet")).paused, { timeout_s: 5, every_ms: 50 });
  await page.locator("button.pause[data-paused=true]").waitFor({ timeout: 5_000 });
  await client.post("/api/v1/fleet/resume", { vehicles: system.plant.model.vehicles.map((v) => v.id) });
  await page.locator("button.pause", { hasText: "Pause fleet" }).waitFor({ timeout: 5_000 });
  await page.context().close();
});

test("a viewer can look and not send", async () => {
  const page = await signedIn(browser, system, "viewer");
  const before = (await client.get("/api/v1/job-orders")).items.length;
  await page.goto(`${system.url}/send?vehicle=TP-01&station=3`);
  const start = page.locator("button.go");
  await start.waitFor();
  await until("the screen says that a viewer may not", async () => /viewer|operator|role|not allowed|may not/i.test(await page.locator(".page").innerText()), { timeout_s: 10, every_ms: 50 });
  await picture(page, "send-viewer");
  assert.equal(await start.getAttribute("aria-disabled"), "true");
  await start.click({ force: true });
  await start.click({ force: true });
  assert.equal((await client.get("/api/v1/job-orders")).items.length, before);
  await page.context().close();
});

test("the floor codes of the stations shown are printed, and listed", async () => {
  const page = await signedIn(browser, system, "viewer");
  await page.goto(`${system.url}/stations`);
  const saved = async (name) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("link", { name, exact: true }).click()]);
    return readFile(await download.path(), "latin1");
  };
  assert.match(await saved("SVG"), /<svg/, "those of all stations fit into one file");
  await page.getByRole("button", { name: /^Ready/ }).click();
  assert.match(await saved("PDF"), /^%PDF-[^]*\/Type \/Page % 2/);
  const list = await saved("List");
  assert.equal(list.trimEnd().split("\n").length, 3, "two codes of the one station that is ready");
  assert.match(list, /^kind,payload,size_m,x_m,y_m,up_rad\nqr,ST04-F,/);
  await page.context().close();
});

test("the server gone: the page says so within 5 s and keeps the vehicles", async () => {
  const page = await signedIn(browser, system, "operator");
  await page.getByText("TP-02").first().waitFor();
  await page.context().setOffline(true);
  await system.kill(system.server);
  await page.getByText(/Link lost/).first().waitFor({ timeout: 5_000 });
  await page.getByText("TP-02").first().waitFor();
  await picture(page, "map-link-cut");
  await system.startServer();
  await page.context().setOffline(false);
  await page.getByText(/Live/).first().waitFor({ timeout: 20_000 });
  for (const id of VEHICLES) await client.untilReady(id);
  const { needs_resume } = await client.get("/api/v1/fleet");
  if (needs_resume.length) await client.post("/api/v1/fleet/resume", { vehicles: needs_resume });
  await page.context().close();
});
