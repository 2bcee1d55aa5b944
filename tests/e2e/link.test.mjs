// Pages that are opened while the link is cut: they say so, and come by themselves when it is back. Nobody presses anything.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";
import { reachFaultsOf } from "../harness/reach.mjs";

let system, client, browser, order;

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles(["MV-01"]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  system.startAgent("MV-01", { seed: 61, sensing: "analytic" });
  await client.untilReady("MV-01");
  order = await client.order("MV-01", [13]);
  await client.untilEnded(order.id);
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

const open = (page, name) => page.locator(`.rail a[href="/${name}"]`).click();

test("a page opened while the link is cut says so, and comes by itself when the link is back", async () => {
  for (const [width, height, lang] of [[1920, 1080, "en"], [390, 844, "zh"]]) {
    const page = await signedIn(browser, system, "operator", { width, height, lang, bypassCSP: true });
    await system.kill(system.server);
    await page.locator(".app[data-link=lost]").waitFor({ timeout: 15_000 });
    await open(page, "vehicles");
    await page.getByRole("status").getByText(lang === "en" ? "It comes by itself when the link is back." : "连接恢复后会自动加载。").waitFor();
    assert.deepEqual(await reachFaultsOf(page), []);
    assert.deepEqual(await faultsOf(page), []);
    await picture(page, `opened-while-cut-${width}-${lang}`);
    await system.startServer();
    await page.getByRole("table").getByRole("link", { name: "MV-01" }).waitFor({ timeout: 30_000 });
    assert.equal(new URL(page.url()).pathname, "/vehicles");
    await page.context().close();
  }
});

test("an answer that failed while the link was cut is asked for again when it is back", async () => {
  const page = await signedIn(browser, system, "operator");
  await open(page, "records");
  await page.getByRole("table").getByText("MV-01").first().waitFor();
  await system.kill(system.server);
  await page.locator(".app[data-link=lost]").waitFor({ timeout: 15_000 });
  await page.getByRole("combobox").first().selectOption("MV-01");
  const failed = page.locator(".amiss");
  await failed.waitFor({ timeout: 15_000 });
  await system.startServer();
  await failed.waitFor({ state: "detached", timeout: 30_000 });
  await page.getByRole("table").getByText("MV-01").first().waitFor();
  await page.context().close();
});

test("a dashboard that was loaded before the server answers begins when it does", async () => {
  const page = await signedIn(browser, system, "operator", { path: "/vehicles" });
  await page.route("**/api/v1/session", (route) => route.abort());
  await page.reload();
  await page.getByRole("alert").waitFor();
  await picture(page, "loaded-while-cut");
  await page.unroute("**/api/v1/session");
  await page.getByRole("table").getByRole("link", { name: "MV-01" }).waitFor({ timeout: 15_000 });
  await page.context().close();
});

test("before anything is heard the map does not say that there are no orders", async () => {
  const page = await signedIn(browser, system, "operator");
  let stream;
  await page.routeWebSocket(/\/api\/v1\/stream/, (one) => { stream = one; });
  await page.goto(`${system.url}/map`);
  const strip = page.locator(".strip");
  await strip.getByText("Open orders", { exact: true }).waitFor();
  await until("it asks to be told", () => stream !== undefined, { timeout_s: 10, every_ms: 20 });
  assert.equal(await strip.getByText("No open orders").count(), 0);
  stream.connectToServer();
  await strip.getByText("No open orders").waitFor();
  assert.deepEqual(page.errors, []);
  await page.context().close();
});
