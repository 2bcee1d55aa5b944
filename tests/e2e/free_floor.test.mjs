// A measuring vehicle in a hall without lanes: Send shows its way over free floor, round the fuselage, before anything is sent.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";
import { withoutLanes } from "../harness/world.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";

const ID = "MV-01", STATION = 5;
let system, client, browser;

before(async () => {
  system = await System.create(withoutLanes("measuring-hall"));
  system.prepareVehicles([ID]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  system.startAgent(ID, { seed: 31, sensing: "analytic" });
  await client.untilReady(ID);
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

for (const [lang, theme, width, height] of [["en", "light", 1920, 1080], ["zh", "dark", 1024, 768]]) {
  test(`Send previews the way over free floor (${lang}, ${width})`, async () => {
    const { body } = await client.request("POST", "/api/v1/motion-previews", { body: { vehicle: ID, station: STATION } });
    const option = body.options.find(({ mode }) => mode === "linear");
    const way = option.segments.filter(({ kind }) => kind !== "rotate");
    assert.ok(way.length >= 3, `round the fuselage it is no straight line: ${JSON.stringify(way)}`);
    const page = await signedIn(browser, system, "operator", { lang, theme, width, height });
    await page.goto(`${system.url}/send?vehicle=${ID}&station=${STATION}`);
    await page.locator(".pmap[data-chosen=linear]").waitFor({ timeout: 20_000 });
    await picture(page, `send-free-floor-${width}-${lang}`);
    assert.deepEqual(await faultsOf(page), []);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}
