// A way that a person chooses and that leads past too few codes: Send says so, and does not refuse it.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";

const ID = "DL-01";
let system, browser, choice;

/** A station and a mode that leads farther without a code than the vehicle is sure for. */
async function blindChoice(client) {
  const { type } = system.plant.vehicle(ID);
  for (const { number, vehicle_types } of system.plant.model.stations) {
    if (vehicle_types?.length && !vehicle_types.includes(type)) continue;
    const { body } = await client.request("POST", "/api/v1/motion-previews", { body: { vehicle: ID, station: number } });
    const blind = body.options?.find(({ codes_on_way: codes }) => codes && codes.widest_gap_m > codes.at_most_m);
    if (blind) return { station: number, mode: blind.mode };
  }
  return undefined;
}

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles([ID]);
  await system.startServer();
  const client = new Client(system.url, system.apiToken);
  system.startAgent(ID, { seed: 42, sensing: "analytic" });
  await client.untilReady(ID);
  choice = await blindChoice(client);
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

for (const [lang, theme, width, height, says] of [
  ["en", "light", 1920, 1080, /without a code, .+ are sure: it may not see the code at the end/],
  ["zh", "dark", 1024, 768, /途中无地面码，可靠距离为/],
]) {
  test(`Send says that a chosen way leads past too few codes (${lang}, ${width})`, async () => {
    assert.ok(choice, "free floor between shelves and bays has no codes");
    const page = await signedIn(browser, system, "operator", { lang, theme, width, height });
    await page.goto(`${system.url}/send?vehicle=${ID}&station=${choice.station}`);
    if (width < 1536) await page.locator(".s3 .chg").click();  // the steps are folded there
    await page.locator(`.mode[data-mode=${choice.mode}]`).click();
    await page.locator(".checks .chk[data-result=note]", { hasText: says }).waitFor({ timeout: 20_000 });
    await picture(page, `send-blind-${width}-${lang}`);
    assert.deepEqual(await faultsOf(page), []);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}
