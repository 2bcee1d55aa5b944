// A tour is written with the number pad: what cannot be is refused in the form, what can be is shown with its time before it is stored.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";
import { picture, signedIn, startBrowser } from "../harness/browser.mjs";

let system, client, browser;

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles(["TP-01"]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  system.startAgent("TP-01", { seed: 41 });
  await client.untilReady("TP-01");
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

test("a wrong station is refused in the form, a right tour shows time and way, and is stored once", async () => {
  const page = await signedIn(browser, system, "operator");
  await page.goto(`${system.url}/orders`);
  await page.getByRole("button", { name: "New order" }).click();
  const form = page.locator(".tour");
  const type = async (digits) => {
    for (const digit of digits) await form.getByRole("button", { name: digit, exact: true }).click();
  };
  await form.getByRole("button", { name: "TP-01", exact: true }).click();
  await type("15");
  await form.getByText("Station 15 is not for this vehicle").waitFor();
  const create = form.locator("button.cmd");
  assert.equal(await create.getAttribute("aria-disabled"), "true");

  await form.getByRole("button", { name: "Clear", exact: true }).or(form.locator(".key", { hasText: "C" })).first().click();
  await type("2");
  await form.getByRole("button", { name: "Add station" }).click();
  await type("3");
  const body = { vehicle: "TP-01", steps: [{ station: 2 }, { station: 3 }] };
  const { steps } = await client.post("/api/v1/job-orders?dryRun=true", body);
  const seconds = steps.reduce((sum, s) => sum + (s.options.find((o) => o.suggested) ?? s.options.find((o) => o.feasible)).duration_s, 0);
  const total = form.getByText(/^About [\d:]+ min in all$/);
  await total.waitFor({ timeout: 20_000 });
  const [, minutes, rest] = /(\d+):(\d\d)/.exec(await total.innerText());
  assert.ok(Math.abs(Number(minutes) * 60 + Number(rest) - seconds) <= 2, `${await total.innerText()} is what the server says: ${seconds} s`);
  await form.locator("canvas").waitFor();
  await picture(page, "tour-1920");

  await create.click();
  await page.locator("[data-state=armed]").getByText(/[1-7] s/).waitFor();
  await page.locator("[data-state=armed]").dblclick();
  await page.waitForURL(/\/orders\/[0-9a-f-]{36}/);
  const orders = await until("the order is stored", async () => { const { items } = await client.get("/api/v1/job-orders?vehicle=TP-01"); return items.length > 0 && items; }, { timeout_s: 5, every_ms: 50 });
  assert.deepEqual(orders.map((o) => o.steps.map((s) => s.number)), [[2, 3]], "a double press is one order");
  assert.deepEqual(page.errors, []);
  await page.context().close();
});
