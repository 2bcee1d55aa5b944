// A measuring vehicle in a hall without lanes: Send shows its way over free floor, round the fuselage, and the codes that a way by
// lanes relies on, before anything is sent.
import assert from "node:assert/strict";
import { mkdtempSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { tmpdir } from "node:os";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { Plant, System } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";

const ID = "MV-01", STATION = 5;
let system, client, browser;

before(async () => {
  const { model } = new Plant("measuring-hall");
  model.roadmap = { nodes: [], edges: [] };
  for (const station of model.stations) delete station.node;
  const file = join(mkdtempSync(join(tmpdir(), "pulseline-plant-")), "free-floor.json");
  writeFileSync(file, JSON.stringify(model));
  system = await System.create(file);
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
  test(`Send previews the way over free floor and the codes that it relies on (${lang}, ${width})`, async () => {
    const { body } = await client.request("POST", "/api/v1/motion-previews", { body: { vehicle: ID, station: STATION } });
    const option = body.options.find(({ mode }) => mode === "linear");
    const way = option.segments.filter(({ kind }) => kind !== "rotate");
    assert.ok(way.length >= 3, `round the fuselage it is no straight line: ${JSON.stringify(way)}`);
    const page = await signedIn(browser, system, "operator", { lang, theme, width, height });
    await page.goto(`${system.url}/send?vehicle=${ID}&station=${STATION}`);
    await page.locator(".pmap[data-chosen=linear]").waitFor({ timeout: 20_000 });
    const codes = option.marker_chain?.markers.length ?? 0;
    assert.equal(await page.locator(`.pmap [data-chain="${codes}"]`).count(), codes > 0 ? 1 : 0);
    await picture(page, `send-free-floor-${width}-${lang}`);
    assert.deepEqual(await faultsOf(page), []);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}
