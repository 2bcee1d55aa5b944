// A vehicle that navigates by reflectors, as people see it.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";

const ID = "MV-01";
let hall, browser;

before(async () => {
  hall = await System.create("measuring-hall");
  hall.prepareVehicles([ID]);
  await hall.startServer();
  hall.startAgent(ID, { seed: 41, sensing: "analytic", extra: ["--fault", "marker-lost"] });
  await new Client(hall.url, hall.apiToken).untilReady(ID);
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await hall?.stop();
});

for (const [lang, theme, width, height, basis, seen] of [
  ["en", "light", 1920, 1080, /Position by reflectors/, /Laser scanner: \d+ reflectors in view/],
  ["zh", "dark", 1024, 768, /由反射板定位/, /激光扫描仪：可见 \d+ 块反射板/],
]) {
  test(`the vehicle's page says how many reflectors it sees (${lang}, ${width})`, async () => {
    const page = await signedIn(browser, hall, "operator", { lang, theme, width, height });
    await page.goto(`${hall.url}/vehicles/${ID}`);
    // Where there is no room for all cards they are behind tabs.
    if (width < 1536) await page.getByRole("tab", { name: lang === "en" ? /Why and pose/ : /原因与位姿/ }).click();
    await page.locator("[data-basis=reflectors]", { hasText: basis }).waitFor({ timeout: 15_000 });
    await page.locator("[data-reflectors]", { hasText: seen }).waitFor({ timeout: 15_000 });
    await picture(page, `reflectors-vehicle-${width}-${lang}`);
    assert.deepEqual(await faultsOf(page), []);
    await page.goto(`${hall.url}/map`);
    await page.locator("canvas").first().waitFor();
    await picture(page, `reflectors-map-${width}-${lang}`);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}
