// A vehicle that navigates by iGPS, and a way without codes that a person has chosen, as people see them.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";

const SIZES = [["en", "light", 1920, 1080], ["zh", "dark", 1024, 768]];
let cell, hall, browser;

before(async () => {
  [cell, hall] = [await System.create("igps-cell"), await System.create("final-assembly")];
  cell.prepareVehicles(["OM-01"]);
  hall.prepareVehicles(["DL-01"]);
  await Promise.all([cell.startServer(), hall.startServer()]);
  cell.startAgent("OM-01", { seed: 41, sensing: "analytic", extra: ["--fault", "transmitter-dark=tx-3"] });
  hall.startAgent("DL-01", { seed: 42, sensing: "analytic" });
  await new Client(cell.url, cell.apiToken).untilReady("OM-01");
  await new Client(hall.url, hall.apiToken).untilReady("DL-01");
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await Promise.all([cell?.stop(), hall?.stop()]);
});

const said = { en: [/Position by iGPS/, /iGPS: all 4 receivers see light, \d transmitters, ±0\.\d\d mm each/], zh: [/由 iGPS 定位/, /iGPS：4 个接收器均有光，\d 台发射器，各 ±0\.\d\d mm/] };

for (const [lang, theme, width, height] of SIZES) {
  test(`the vehicle's page says what it navigates by (${lang}, ${width})`, async () => {
    const page = await signedIn(browser, cell, "operator", { lang, theme, width, height });
    await page.goto(`${cell.url}/vehicles/OM-01`);
    const why = page.getByRole("tab", { name: lang === "en" ? /Why and pose/ : /原因与位姿/ });
    if (await why.count()) await why.click();
    const [basis, light] = said[lang];
    await page.locator("[data-basis=receivers]", { hasText: basis }).waitFor({ timeout: 15_000 });
    await page.locator("[data-light=all]", { hasText: light }).waitFor({ timeout: 15_000 });
    await picture(page, `igps-vehicle-${width}-${lang}`);
    assert.deepEqual(await faultsOf(page), []);
    await page.goto(`${cell.url}/map`);
    await page.locator("canvas").first().waitFor();
    await picture(page, `igps-map-${width}-${lang}`);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}

/** A station and a mode of DL-01 that leads farther without a code than it is sure for. */
async function blindChoice() {
  const client = new Client(hall.url, hall.apiToken);
  for (const { number, vehicle_types } of hall.plant.model.stations) {
    if (vehicle_types?.length && !vehicle_types.includes("delivery-vehicle")) continue;
    const { body } = await client.request("POST", "/api/v1/job-orders?dryRun=true", { body: { vehicle: "DL-01", steps: [{ station: number }] } });
    const modes = body.steps?.[0]?.modes ?? [];
    const blind = modes.find(({ codes_on_way: codes }) => codes && codes.widest_gap_m > codes.at_most_m);
    if (blind) return { station: number, ...blind };
  }
  return undefined;
}

for (const [lang, theme, width, height] of SIZES) {
  test(`Send says that a chosen way leads past too few codes (${lang}, ${width})`, async () => {
    const choice = await blindChoice();
    assert.ok(choice, "free floor between the shelves and the bays has no codes");
    const page = await signedIn(browser, hall, "operator", { lang, theme, width, height });
    await page.goto(`${hall.url}/send?vehicle=DL-01&station=${choice.station}&mode=${choice.mode}`);
    const note = page.locator(".checks .chk[data-result=note]", { hasText: lang === "en" ? /code/ : /地面码/ });
    await note.first().waitFor({ timeout: 20_000 });
    await picture(page, `send-blind-${width}-${lang}`);
    assert.deepEqual(await faultsOf(page), []);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}
