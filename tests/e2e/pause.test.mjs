// Pause in Chromium against the real server and two real agents: a frightened finger never lets anything go, and the
// screen says "stands" only when the vehicle does. The world's own log is the judge.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";
import { reachFaultsOf } from "../harness/reach.mjs";

const VEHICLES = ["TP-01", "MV-01"];
let system, client, browser;

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles(VEHICLES);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  VEHICLES.forEach((id, i) => system.startAgent(id, { seed: 21 + i, timeFactor: 1, sensing: "analytic" }));
  for (const id of VEHICLES) await client.untilReady(id);
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

/** Where the middle of something is now: a finger does not follow what moves away under it. */
async function middleOf(locator) {
  const { x, y, width, height } = await locator.boundingBox();
  return [x + width / 2, y + height / 2];
}

/** Taps of one finger at one place, as fast as a frightened person taps. */
async function tap(page, [x, y], times) {
  for (let i = 0; i < times; ++i) {
    await page.mouse.click(x, y);
    await page.waitForTimeout(350); // the rhythm of the finger; nothing waits for it
  }
}

/** What the page asks of the server from now on: "pause", "resume", ... */
function commandsOf(page) {
  const sent = [];
  page.on("request", (request) => request.method() === "POST" && sent.push(new URL(request.url()).pathname));
  return sent;
}

const isDriving = (v) => v.activity === "moving" && Math.abs(v.speed_mps) > 0.2;
const moves = (id) => system.lastTruth(id).moving;

test("eight taps on Pause are a pause: it says Stopping until the platform stands, and Resume is elsewhere", async () => {
  const page = await signedIn(browser, system, "operator", { path: "/vehicles/TP-01", bypassCSP: true });
  const order = await client.order("TP-01", [2]);
  const pause = page.locator(".pausecmd");
  const place = await middleOf(pause);
  await client.untilVehicle("TP-01", isDriving, "drives");
  const sent = commandsOf(page);
  await page.mouse.click(...place);
  await page.locator(".pausecmd", { hasText: "Stopping" }).waitFor({ timeout: 3000 });
  assert.ok(moves("TP-01"), "it still moves while the screen says so");
  await picture(page, "pause-stopping");
  await tap(page, place, 8);
  assert.deepEqual(sent.filter((path) => /resume/.test(path)), [], "nothing let it go");
  assert.deepEqual([...new Set(sent)], ["/api/v1/vehicles/TP-01/pause"]);

  await page.locator(".pausecmd", { hasText: "Paused" }).waitFor({ timeout: 15_000 });
  assert.ok(!moves("TP-01"), "it stands when the screen says that it does");
  assert.deepEqual(await middleOf(pause), place, "Pause has kept its place");
  await page.getByText(/^Paused by operator at \d\d:\d\d:\d\d\. It stands\./).first().waitFor();
  await picture(page, "pause-stands");
  assert.deepEqual(await faultsOf(page), []);

  const resume = page.locator(".card.held .cmd");
  const [x, y] = await middleOf(resume);
  assert.ok(Math.abs(x - place[0]) > 300 || Math.abs(y - place[1]) > 100, "Resume is not where Pause is");
  // The guard is up for three seconds after the newest tap; a person who decides comes later.
  await until("Resume can be armed", async () => {
    await resume.click();
    return page.locator(".card.held .cmd[data-state=armed]").waitFor({ timeout: 700 }).then(() => true, () => false);
  }, { timeout_s: 10, every_ms: 300 });
  await page.getByText(/[1-7] s left/).waitFor();
  await resume.click();
  await client.untilVehicle("TP-01", isDriving, "drives on");
  assert.equal((await client.untilEnded(order.id)).state, "Ended");
  assert.deepEqual(page.errors, []);
  await page.context().close();
});

for (const [width, height, lang, station] of [[1024, 768, "zh", 1], [390, 844, "en", 2]]) {
  test(`eight taps on Pause at ${width} x ${height} are a pause, too`, async () => {
    const page = await signedIn(browser, system, "operator", { path: "/vehicles/TP-01", width, height, lang });
    const order = await client.order("TP-01", [station]);
    await client.untilVehicle("TP-01", isDriving, "drives");
    const place = await middleOf(page.locator(".pausecmd"));
    const sent = commandsOf(page);
    await tap(page, place, 8);
    await client.untilVehicle("TP-01", (v) => v.pause?.stands, "stands");
    await tap(page, place, 4);
    assert.deepEqual([...new Set(sent)], ["/api/v1/vehicles/TP-01/pause"]);
    assert.deepEqual(await middleOf(page.locator(".pausecmd")), place, "Pause has kept its place");
    await page.locator(".card.held .cmd").waitFor();
    assert.deepEqual(await reachFaultsOf(page), []);
    await page.getByRole("link", { name: lang === "zh" ? `查看 ${order.name}` : `Show ${order.name}` }).click();
    await page.waitForURL(`**/orders/${order.id}`);
    await page.locator(".cmd", { hasText: lang === "zh" ? "取消任务" : "Cancel order" }).waitFor();
    await page.context().close();
    await client.post("/api/v1/fleet/resume", { vehicles: ["TP-01"] });
    assert.equal((await client.untilEnded(order.id)).state, "Ended");
  });
}

test("Pause fleet: Stopping until all stand, by whom on every page, and who was paused singly is not ticked", async () => {
  await client.post("/api/v1/vehicles/MV-01/pause");
  const page = await signedIn(browser, system, "operator", { path: "/map", bypassCSP: true });
  await client.order("TP-01", [1]);
  const corner = page.locator("button.pause");
  const place = await middleOf(corner);
  await client.untilVehicle("TP-01", isDriving, "drives");
  const sent = commandsOf(page);
  await page.mouse.click(...place);
  await page.locator("button.pause", { hasText: "1 of 2 still move" }).waitFor({ timeout: 3000 });
  assert.ok(moves("TP-01"));
  await picture(page, "fleet-stopping");
  await tap(page, place, 6);
  await page.locator("button.pause", { hasText: "all 2 stand" }).waitFor({ timeout: 15_000 });
  assert.ok(!moves("TP-01"));
  assert.deepEqual([...new Set(sent)], ["/api/v1/fleet/pause"]);
  assert.equal(await page.locator(".resume").count(), 0, "no panel has opened under the finger");

  for (const path of ["/orders", "/send", "/vehicles/MV-01", "/stations"]) {
    await page.goto(`${system.url}${path}`);
    await page.getByText(/Fleet paused by operator at \d\d:\d\d:\d\d/).waitFor();
  }
  await page.getByRole("button", { name: "Resume…" }).click();
  await page.keyboard.press("Escape");
  assert.equal(await page.locator(".resume").count(), 0, "Escape closes it: the focus was inside");
  await page.getByRole("button", { name: "Resume…" }).click();
  const panel = page.getByRole("complementary", { name: "Let vehicles move again" });
  const ticks = (name) => panel.getByRole("group", { name }).getByRole("checkbox");
  assert.equal(await ticks(/^Paused singly/).count(), 1);
  assert.equal(await ticks(/^Paused singly/).isChecked(), false);
  assert.equal(await ticks("Paused with the fleet").and(page.locator(":checked")).count() > 0, true);
  await picture(page, "fleet-resume");
  assert.deepEqual(await faultsOf(page), []);
  const go = panel.locator(".cmd");
  await go.click();
  await page.getByText(/[1-7] s left/).waitFor();
  await go.click();
  await client.untilVehicle("TP-01", isDriving, "drives on");
  assert.equal((await client.get("/api/v1/vehicles/MV-01")).paused, true, "its own pause still holds");
  await page.getByText(/MV-01/).first().waitFor();
  await page.locator(".banner.held", { hasText: "MV-01" }).waitFor();
  await client.post("/api/v1/fleet/resume", { vehicles: ["MV-01"] });
  await page.locator(".banner.held").waitFor({ state: "detached" });
  assert.deepEqual(page.errors, []);
  await page.context().close();
});

test("the move that is watched can be paused and cancelled there, and the cancel ends on the screen", async () => {
  const open = (await client.get("/api/v1/job-orders?vehicle=TP-01")).items.filter((o) => !["Ended", "Aborted"].includes(o.state));
  for (const one of open) await client.untilEnded(one.id);
  const page = await signedIn(browser, system, "operator");
  const order = await client.order("TP-01", [2]);
  await page.goto(`${system.url}/send?order=${order.id}`);
  await client.untilVehicle("TP-01", isDriving, "drives");
  const bar = page.locator(".confirm");
  const pause = bar.locator(".pausecmd");
  assert.ok((await pause.boundingBox()).height >= 76, "high enough for gloves");
  await picture(page, "send-moving");
  await pause.click();
  await page.locator(".move .held", { hasText: "It stands" }).waitFor({ timeout: 15_000 });
  await picture(page, "send-paused");
  const cancel = bar.locator(".cmd", { hasText: "Cancel order" });
  await cancel.click();
  await page.getByText(/[1-7] s left/).waitFor();
  await bar.locator(".cmd[data-state=armed]").click();
  assert.equal((await client.untilEnded(order.id)).state, "Aborted");
  await bar.getByRole("button", { name: "Next move" }).waitFor();
  assert.equal(await page.getByText(/waiting for TP-01|waiting until/).count(), 0, "nothing is pending any more");
  await page.goto(`${system.url}/orders/${order.id}`);
  await page.getByText(/Cancelled by operator|Aborted/).first().waitFor();
  assert.equal(await page.locator(".odetail .cmd").count(), 0);
  await client.post("/api/v1/fleet/resume", { vehicles: ["TP-01"] });
  assert.deepEqual(page.errors, []);
  await page.context().close();
});
