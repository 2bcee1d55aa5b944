// What the screen says of vehicles that are at fault, busy or lost, in Chromium against the real server and real agents
// with real faults: a broken wheel, dark cameras, somebody else's order, a cut link.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";

const VEHICLES = ["TP-01", "TP-02", "MV-01"];
let system, client, browser;

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles(VEHICLES);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  system.startAgent("TP-01", { seed: 31, timeFactor: 4, sensing: "analytic" });
  system.startAgent("TP-02", { seed: 32, sensing: "analytic", extra: ["--fault", "wheel=front drive@1"] });
  system.startAgent("MV-01", { seed: 33, extra: ["--fault", "camera-dark@1"] });
  for (const id of VEHICLES) await client.untilReady(id);
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

test("Start says why it is off for a station that is not for the vehicle; an order under way is named with its arrival", async () => {
  const page = await signedIn(browser, system, "operator");
  await page.goto(`${system.url}/send?vehicle=TP-01&station=15`);
  const start = page.locator("button.go");
  await page.locator("button.go", { hasText: "Station 15 is not for this vehicle" }).waitFor();
  assert.equal(await start.getAttribute("aria-disabled"), "true");

  await page.goto(`${system.url}/send?vehicle=TP-01&station=3`);
  await page.locator(".mode[role=radio]").first().waitFor({ timeout: 20_000 });
  const order = await client.order("TP-01", [2]);
  await page.locator(".busy strong", { hasText: new RegExp(`TP-01 is on its way to 2 \\(${order.name}, by .+, (there \\d\\d:\\d\\d:\\d\\d|late .+)\\)`) }).waitFor({ timeout: 10_000 });
  assert.equal(await page.getByText(/already stands/).count(), 0);
  await picture(page, "send-busy");
  assert.equal((await client.untilEnded(order.id)).state, "Ended");
  // The order has ended for the server before the page has heard of it, and while the note stands Start is ready, too: to send after.
  await page.locator(".busy").waitFor({ state: "detached", timeout: 15_000 });
  await until("it may be sent on", async () => (await start.getAttribute("data-state")) === "ready", { timeout_s: 15, every_ms: 100 });
  assert.deepEqual(page.errors, []);
  await page.context().close();
});

test("at an occupied station the bar says for which vehicle it will wait, and the check names it", async () => {
  const { number } = system.plant.model.stations.find((s) => s.id === system.plant.vehicle("TP-02").home);
  for (const [lang, waits, check, line] of [
    ["en", `It will wait for TP-02, which stands at station ${number}.`, `Station ${number} is taken: will wait for TP-02`, /^ ?\d to wait for, .*\d+ pass$/],
    ["zh", `将等待 TP-02：它正停在 ${number} 号站。`, `${number} 号站被占用：将等待 TP-02`, /^ ?\d 项须等待，.*\d+ 项通过$/],
  ]) {
    const page = await signedIn(browser, system, "operator", { lang });
    await page.goto(`${system.url}/send?vehicle=TP-01&station=${number}`);
    await page.locator(".confirm .waits", { hasText: waits }).waitFor({ timeout: 20_000 });
    const row = page.locator(".checks .chk[data-result=note]", { hasText: check });
    await row.waitFor();
    assert.equal(await row.locator("svg use[href$='a-2']").count(), 1, "amber, as in the bar");
    await page.locator(".s4 .ans.r", { hasText: line }).waitFor();
    assert.equal(await page.locator("button.go").getAttribute("data-state"), "ready", "a person may decide to wait");
    await picture(page, `send-occupied-${lang}`);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  }
});

test("the page says what a pose rests on: the stop, and how far it has driven since", async () => {
  const page = await signedIn(browser, system, "operator", { path: "/vehicles/TP-01" });
  await page.locator(".basis", { hasText: /Stop measured at station 2, \d\d:\d\d:\d\d, not moved since/ }).waitFor();
  const order = await client.order("TP-01", [3]);
  await page.locator(".basis", { hasText: /Stop measured at station 2, .*, driven [\d.]+\sm since, by its own reckoning/ }).waitFor({ timeout: 20_000 });
  assert.equal((await client.untilEnded(order.id)).state, "Ended");
  await page.locator(".basis", { hasText: "Stop measured at station 3" }).waitFor();
  await page.locator("[data-codes]", { hasText: /Codes on the way: [1-9]\d* of [1-9]\d* read, last \S+/ }).waitFor();
  await picture(page, "pose-codes");
  await client.post("/api/v1/vehicles/TP-01/init-position", { ...(await client.get("/api/v1/vehicles/TP-01")).pose, within_m: 0.01, within_rad: 0.002 }); // measured
  await page.locator(".basis", { hasText: /Stated by .+: measured by nothing/ }).waitFor({ timeout: 10_000 });
  assert.deepEqual(page.errors, []);
  await page.context().close();
});

test("a broken wheel and a stop that was not measured: headline, list, counters, and what to do", async () => {
  const order = await client.order("MV-01", [13]);
  await client.untilVehicle("TP-02", (v) => v.wheels.some((w) => w.fault !== ""), "has a broken wheel");
  await client.untilOrder(order.id, (o) => o.state === "Interrupted", "is interrupted");
  for (const [lang, wheel, todo, stop] of [
    ["en", "Wheel front drive: fault of the steering drive", "Have the wheel looked at before it moves on.", /^The stop at station 13 could not be measured/],
    ["zh", "前驱动轮：转向驱动故障", "继续行驶前请检修该车轮。", /^13 号站的停站未能测量/],
  ]) {
    const page = await signedIn(browser, system, "operator", { lang, path: "/vehicles/TP-02", bypassCSP: true });
    await page.locator(".why .ans1", { hasText: wheel }).waitFor();
    await page.locator(".why .todo", { hasText: todo }).waitFor();
    await picture(page, `alarm-wheel-${lang}`);
    assert.deepEqual(await faultsOf(page), []);
    await page.goto(`${system.url}/map`);
    const row = (id) => page.locator(`.g-attention [data-vehicle="${id}"]`);
    await row("TP-02").locator(".what", { hasText: wheel }).waitFor();
    const what = await row("MV-01").locator(".what").innerText();
    assert.match(what, stop);
    assert.doesNotMatch(what, /no_marker|No camera|steering_drive/, "words, not the vehicle's codes or prose");
    assert.equal(await page.locator(".al.has-2").innerText(), "2", "both are counted");
    await picture(page, `alarm-list-${lang}`);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  }
});

test("with the link cut nothing looks fresh, and no check passes", async () => {
  await client.untilEnded((await client.order("TP-01", [2])).id);
  // What the pages are made of comes before the link is cut.
  const page = await signedIn(browser, system, "operator", { path: "/orders" });
  await page.locator("table.rows tbody tr a").first().click();
  await page.locator(".odetail .ans1").waitFor();
  await page.locator(".rail a[href='/vehicles']").click();
  await page.getByRole("link", { name: "TP-01" }).click();
  await page.locator(".why .chk[data-result=pass]").first().waitFor();
  await until("all of it is fresh", async () => (await page.locator(".chk[data-stale=true]").count()) === 0, { timeout_s: 10, every_ms: 100 });
  await page.context().setOffline(true);
  await system.kill(system.server);
  await page.locator(".app[data-link=lost]").waitFor({ timeout: 5000 });
  await page.locator(".chips.old").waitFor();
  await page.locator(".pbox.stale").waitFor();
  assert.equal(await page.locator(".why .chk[data-result=pass]:not([data-stale=true])").count(), 0);
  assert.equal(await page.locator(".why .chk svg use[href$=c-ok]").count(), 0, "no tick");
  await picture(page, "vehicle-link-cut");
  await page.locator(".rail a[href='/map']").click();
  await page.locator(".veh.old[data-vehicle='TP-01']").waitFor();
  assert.equal(await page.locator(".veh[data-vehicle]:not(.old)").count(), 0);
  assert.match(await page.locator(".veh.old[data-vehicle='TP-01']").evaluate((row) => getComputedStyle(row).backgroundImage), /gradient/, "hatched");
  await page.locator(".strip.old").waitFor();
  await picture(page, "map-link-cut-list");
  await page.setViewportSize({ width: 760, height: 1024 });
  for (const text of await page.locator(".banner .txt:visible > *").all()) {
    assert.ok(await text.evaluate((e) => e.scrollWidth <= e.clientWidth + 1 && e.scrollHeight <= e.clientHeight + 1), `on a tablet it is whole: ${await text.innerText()}`);
  }
  await page.locator(".rail a[href='/orders']").click();
  await page.locator("table.rows tbody tr a").first().click();
  for (const what of [".odetail .ans1", ".odetail td"]) {
    assert.match(await page.locator(what).first().evaluate((e) => getComputedStyle(e).backgroundImage), /gradient/, `${what} is hatched`);
  }
  await picture(page, "order-link-cut");
  assert.deepEqual(page.errors, []);
  await page.context().close();
});
