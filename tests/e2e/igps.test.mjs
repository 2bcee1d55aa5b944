// A vehicle that navigates by iGPS, as people see it.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";

const SIZES = [["en", "light", 1920, 1080], ["zh", "dark", 1024, 768]];
let cell, browser;

before(async () => {
  cell = await System.create("igps-cell");
  cell.prepareVehicles(["OM-01"]);
  await cell.startServer();
  cell.startAgent("OM-01", { seed: 41, sensing: "analytic", extra: ["--fault", "transmitter-dark=tx-3"] });
  await new Client(cell.url, cell.apiToken).untilReady("OM-01");
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await cell?.stop();
});

const said = { en: [/Position by iGPS/, /iGPS: all 4 receivers see light, \d transmitters, ±0\.\d\d mm each/], zh: [/由 iGPS 定位/, /iGPS：4 个接收器均有光，\d 台发射器，各 ±0\.\d\d mm/] };

for (const [lang, theme, width, height] of SIZES) {
  test(`the vehicle's page says what it navigates by (${lang}, ${width})`, async () => {
    const page = await signedIn(browser, cell, "operator", { lang, theme, width, height });
    await page.goto(`${cell.url}/vehicles/OM-01`);
    // Where there is no room for all cards they are behind tabs.
    if (width < 1536) await page.getByRole("tab", { name: lang === "en" ? /Why and pose/ : /原因与位姿/ }).click();
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
