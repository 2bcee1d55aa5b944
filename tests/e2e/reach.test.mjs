// Every page on a wall screen, a tablet and a phone, in both languages and both themes: no sideways scroll, Pause fleet in its corner,
// no command that is too small, cut off or covered, and nothing that axe finds.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";
import { reachFaultsOf } from "../harness/reach.mjs";

const VEHICLES = ["TP-01", "MV-01"];
let system, client, browser, stop, order;

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles(VEHICLES);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  VEHICLES.forEach((id, i) => system.startAgent(id, { seed: 21 + i }));
  for (const id of VEHICLES) await client.untilReady(id);
  order = await client.order("TP-01", [2]);
  browser = await startBrowser();
  await client.untilEnded(order.id, 90);
  [stop] = await client.stops(order.id);
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

const pages = () => [
  ["map", "/map?vehicle=TP-01"],
  ["floor", "/map?floor=1"],
  ["place", "/map?place=TP-01"],
  ["send", "/send?vehicle=TP-01&station=3"],
  ["send-empty", "/send"],
  ["orders", "/orders"],
  ["order", `/orders/${order.id}`],
  ["stations", "/stations"],
  ["vehicles", "/vehicles"],
  ["vehicle", "/vehicles/TP-01"],
  ["records", "/records"],
  ["record", `/records/${stop.id}`],
];

// axe once a size: what it finds does not hang on the language, and contrasts are the same tokens everywhere.
for (const [width, height, lang, theme, axe] of [
  [390, 844, "en", "light", true],
  [390, 844, "zh", "dark", false],
  [1024, 768, "zh", "light", false],
  [1024, 768, "en", "dark", true],
  [1920, 1080, "zh", "dark", true],
]) {
  test(`every page at ${width} x ${height}, ${lang}, ${theme}: all in reach`, async () => {
    const page = await signedIn(browser, system, "operator", { width, height, lang, theme, bypassCSP: true });
    for (const [name, path] of pages()) {
      await page.goto(system.url + path);
      await page.locator("main .card, main .mappage").first().waitFor();
      await until("the data has come", async () => (await page.locator(".page").innerText()).length > 25, { timeout_s: 10, every_ms: 50 });
      if (name === "send") await page.locator(".mode[role=radio]").first().waitFor({ state: "attached", timeout: 20_000 });
      await picture(page, `reach-${name}-${width}-${theme}-${lang}`);
      assert.deepEqual(await reachFaultsOf(page), [], `${name}: reach`);
      // Sizes are measured above, each target scrolled into sight; axe takes a row at the edge of a list for a small one.
      if (axe) assert.deepEqual(await faultsOf(page, { without: ["target-size"] }), [], `${name}: accessibility`);
    }
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}

test("the user's menu on a phone holds language and theme", async () => {
  const page = await signedIn(browser, system, "operator", { width: 390, height: 844 });
  await page.locator(".who > button").click();
  await page.locator(".menu").getByRole("button", { name: "中文" }).click();
  await page.getByRole("link", { name: "地图" }).waitFor();
  await page.context().close();
});
