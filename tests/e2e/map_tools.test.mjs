// What a person does on the map besides looking: close floor and reopen it, say where a vehicle stands, print a station's codes.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";
import { picture, signedIn, startBrowser } from "../harness/browser.mjs";

const VEHICLES = ["TP-01", "MV-01"];
let system, client, browser;

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles(VEHICLES);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  VEHICLES.forEach((id, i) => system.startAgent(id, { seed: 31 + i }));
  for (const id of VEHICLES) await client.untilReady(id);
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

/** Counts what a person presses. */
function hand(page) {
  let presses = 0;
  return {
    get presses() { return presses; },
    async press(locator) { ++presses; await locator.click(); },
    /** A place of the hall on the fitted map, by the drawing's own margins. */
    async pressMap(x_m, y_m) {
      ++presses;
      const canvas = page.locator("canvas.canvas");
      const box = await canvas.boundingBox();
      const hall = system.plant.model.halls[0].outline;
      const [w, h] = [Math.max(...hall.map((p) => p.x_m)), Math.max(...hall.map((p) => p.y_m))];
      const rim = { left: 52, top: 36, right: 24, bottom: 34 };
      const k = Math.min((box.width - rim.left - rim.right) / w, (box.height - rim.top - rim.bottom) / h);
      const x = rim.left + (box.width - rim.left - rim.right - k * w) / 2 + k * x_m;
      const y = rim.top + (box.height - rim.top - rim.bottom - k * h) / 2 + k * (h - y_m);
      await canvas.click({ position: { x, y } });
    },
  };
}
/** Arms a command and presses again once a second press counts. */
async function twice(me, page, name) {
  await me.press(page.locator("button.cmd", { hasText: name }));
  await page.locator("[data-state=armed]").getByText(/[1-7] s/).waitFor();
  await me.press(page.locator("[data-state=armed]"));
}

test("an area is closed in five presses, bars the way in Send, and is reopened", async () => {
  const page = await signedIn(browser, system, "operator");
  const me = hand(page);
  await page.locator("canvas.canvas").waitFor();
  await me.press(page.getByRole("button", { name: "Close floor" }));
  await me.pressMap(12, 28);
  await me.pressMap(18, 23);
  await twice(me, page, "Close this floor");
  const closed = await until("the floor is closed", async () => (await client.get("/api/v1/traffic")).closures[0], { timeout_s: 5, every_ms: 50 });
  assert.ok(me.presses <= 5, `${me.presses} presses`);
  const xs = closed.outline.map((p) => p.x_m);
  const ys = closed.outline.map((p) => p.y_m);
  for (const [got, want] of [[Math.min(...xs), 12], [Math.max(...xs), 18], [Math.min(...ys), 23], [Math.max(...ys), 28]]) {
    assert.ok(Math.abs(got - want) < 0.5, `${got} is where ${want} was pressed`);
  }
  const row = page.locator(".closures li", { hasText: "Work" });
  await row.getByText(/by operator, since \d\d:\d\d/).waitFor();
  await picture(page, "floor-closed-1920");

  const other = await signedIn(browser, system, "operator");
  await other.goto(`${system.url}/send?vehicle=TP-01&station=2`);
  await other.locator(".checks").getByText("Floor").first().waitFor({ timeout: 20_000 });
  const { steps } = await client.post("/api/v1/job-orders?dryRun=true", { vehicle: "TP-01", steps: [{ station: 2, motion_mode: "auto" }] });
  const [step] = steps;
  const chosen = step.options.find((o) => o.suggested) ?? step.options.find((o) => o.feasible);
  assert.equal(chosen.closures?.length, 1, "the way leads over it");
  await other.getByText(/Closed on the way: Work, by operator/).first().waitFor();
  assert.equal(await other.locator("button.go").getAttribute("aria-disabled"), "true");
  await picture(other, "send-floor-1920");
  await other.context().close();

  await twice(me, page, "Reopen");
  await page.getByText("No floor is closed.").waitFor();
  assert.deepEqual((await client.get("/api/v1/traffic")).closures, []);
  assert.deepEqual(page.errors, []);
  await page.context().close();
});

test("a lane is closed with both its directions in four presses", async () => {
  const page = await signedIn(browser, system, "operator");
  const me = hand(page);
  await page.locator("canvas.canvas").waitFor();
  const nodes = new Map(system.plant.model.roadmap.nodes.map((n) => [n.id, n.position]));
  const far = system.plant.model.roadmap.edges
    .map((e) => ({ id: e.id, a: nodes.get(e.from), b: nodes.get(e.to) }))
    .sort((p, q) => Math.hypot(q.a.x_m - q.b.x_m, q.a.y_m - q.b.y_m) - Math.hypot(p.a.x_m - p.b.x_m, p.a.y_m - p.b.y_m))[0];
  await me.press(page.getByRole("button", { name: "Close floor" }));
  await me.pressMap((far.a.x_m + far.b.x_m) / 2, (far.a.y_m + far.b.y_m) / 2);
  await page.getByText(/1 lane is marked/).waitFor();
  await twice(me, page, "Close this floor");
  const closed = await until("the lane is closed", async () => (await client.get("/api/v1/traffic")).closures[0], { timeout_s: 5, every_ms: 50 });
  assert.equal(me.presses, 4);
  assert.ok(closed.edges.includes(far.id));
  // Who looks at another page sees it at once, and may reopen it there.
  await page.goto(`${system.url}/map`);
  await page.getByRole("button", { name: "Closed floor 1" }).waitFor();
  await client.request("DELETE", `/api/v1/closures/${closed.id}`);
  await page.getByRole("button", { name: "Close floor" }).waitFor();
  await page.context().close();
});

test("a vehicle is told on the map that it stands at a station, in four presses, and then in fine steps", async () => {
  const page = await signedIn(browser, system, "operator");
  await page.goto(`${system.url}/vehicles/MV-01`);
  const me = hand(page);
  await me.press(page.getByRole("link", { name: "Show on the map" }));
  await page.getByText(/Press its station on the map/).waitFor();
  const station = system.plant.station(18);
  await me.pressMap(station.pose.x_m, station.pose.y_m);
  await page.getByText(/At station 18/).waitFor();
  await twice(me, page, "Set position");
  assert.equal(me.presses, 4);
  const near = (v, x, y) => v.pose_known && Math.hypot(v.pose.x_m - x, v.pose.y_m - y) < 0.05;
  await client.untilVehicle("MV-01", (v) => near(v, station.pose.x_m, station.pose.y_m), "stands at 18");
  await page.locator("[data-state=confirmed]").waitFor({ timeout: 5_000 });
  await picture(page, "place-1920");

  await page.goto(`${system.url}/map?place=MV-01`);
  await page.getByRole("button", { name: "One step east" }).click();
  await page.getByRole("button", { name: "0.01 m, 0.1°" }).click();
  await page.getByRole("button", { name: "One step north" }).click();
  await twice(me, page, "Set position");
  await client.untilVehicle("MV-01", (v) => Math.abs(v.pose.x_m - station.pose.x_m - 0.1) < 0.005 && Math.abs(v.pose.y_m - station.pose.y_m - 0.01) < 0.005, "stands a step farther");
  assert.deepEqual(page.errors, []);
  await page.context().close();
});

test("a busy vehicle's place is refused in words", async () => {
  const page = await signedIn(browser, system, "operator");
  const me = hand(page);
  await page.goto(`${system.url}/map?place=TP-01`);
  await page.getByRole("button", { name: "One step east" }).click();
  const order = await client.order("TP-01", [7, 1, 7]);
  await client.untilVehicle("TP-01", (v) => v.activity === "moving", "is on its way");
  await twice(me, page, "Set position");
  const alert = page.locator(".tool [role=alert]");
  await alert.waitFor({ timeout: 10_000 });
  assert.match(await alert.innerText(), /TP-01 is busy/);
  await client.post(`/api/v1/job-orders/${order.id}/cancel`);
  assert.deepEqual(page.errors, []);
  await page.context().close();
});

test("one station's codes are printed from its own place", async () => {
  const page = await signedIn(browser, system, "viewer");
  await page.goto(`${system.url}/stations`);
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("link", { name: "Print the floor codes of station 7", exact: true }).click()]);
  assert.match(await readFile(await download.path(), "latin1"), /^%PDF-[^]*\/Type \/Page % 2/, "its two codes and no other");
  await page.context().close();
});
