// Taking an aircraft over and setting it down from the vehicle's page, in Chromium against the real server and a real agent:
// two presses each, at a desk, on a tablet and on a phone; the page shows what the brackets feel and who has the aircraft.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { ROOT, System, until } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";
import { overlapsOf, reachFaultsOf } from "../harness/reach.mjs";

const kId = "TP-01", kLoad = "A-101";
let system, client, browser;

/** The pulse line on the morning of an aircraft: it hangs at station 1, the platform stands empty below it. */
function morning() {
  const model = JSON.parse(readFileSync(join(ROOT, "db/plants/pulse-line.json"), "utf8"));
  for (const hall of model.halls) delete hall.occupancy_yaml;
  model.stations[0].support = { height_m: 0.02 };
  delete model.loads[0].vehicle;
  model.loads[0].station = model.stations[0].id;
  const file = join(mkdtempSync(join(tmpdir(), "pulseline-plant-")), "morning.json");
  writeFileSync(file, JSON.stringify(model));
  return file;
}

before(async () => {
  system = await System.create(morning());
  system.prepareVehicles([kId]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  system.startAgent(kId, { seed: 22, timeFactor: 4, sensing: "analytic" });
  await client.untilReady(kId);
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

/** A command of two steps, by a person who waits between them: the guard is up for three seconds after a stop. */
async function decide(page, name) {
  const button = page.locator(".lifts .cmd", { hasText: name });
  await button.scrollIntoViewIfNeeded();
  await until("it can be armed", async () => {
    await button.click();
    return page.locator(".lifts .cmd[data-state=armed]").waitFor({ timeout: 700 }).then(() => true, () => false);
  }, { timeout_s: 10, every_ms: 500 });
  await page.waitForTimeout(450); // a second press that comes sooner is the same tap
  await page.locator(".lifts .cmd[data-state=armed]").click();
}
const untilIt = (condition, what) => client.untilVehicle(kId, condition, what, 90);

const kWays = [
  { width: 1920, height: 1080, lang: "en", theme: "light", take: "Take over A-101", set: "Set down A-101" },
  { width: 1024, height: 768, lang: "zh", theme: "dark", take: "接取 A-101", set: "放下 A-101" },
  { width: 390, height: 844, lang: "en", theme: "dark", take: "Take over A-101", set: "Set down A-101" },
];
for (const { width, height, lang, theme, take, set } of kWays) {
  test(`taken over and set down again with two presses each at ${width} x ${height}`, async () => {
    const page = await signedIn(browser, system, "operator", { path: `/vehicles/${kId}`, width, height, lang, theme, bypassCSP: true });
    const card = page.locator(".lifts");
    await card.waitFor();
    if (!(await card.evaluate((e) => e.open))) await card.locator("summary").click();
    await decide(page, take);
    await untilIt((v) => v.lift?.type === "pick" && v.lift.state === "under_way", "takes it over");
    await untilIt((v) => v.lift.state !== "under_way" && v.load === kLoad, "carries it");
    await page.locator(".lifts .cmd", { hasText: set }).waitFor();
    await page.locator(".chip", { hasText: kLoad }).first().waitFor();
    await picture(page, `loads-${width}-${lang}`);
    assert.deepEqual(await reachFaultsOf(page), []);
    assert.deepEqual(await overlapsOf(page), []);
    if (width === 1920) assert.deepEqual(await faultsOf(page), []);
    await decide(page, set);
    await untilIt((v) => v.lift.type === "drop" && v.lift.state === "done" && v.load === undefined, "has set it down");
    await page.locator(".lifts .cmd", { hasText: take }).waitFor();
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}
