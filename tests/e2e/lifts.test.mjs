// Brackets and parking feet worked from the vehicle's page, in Chromium against the real server and a real agent: two presses
// move them, one press of anybody holds them, and the page says what the vehicle's own sensors say.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { until } from "../harness/processes.mjs";
import { hallWith } from "../harness/one_vehicle.mjs";
import { decide, faultsOf, picture, signedIn } from "../harness/browser.mjs";
import { overlapsOf, reachFaultsOf } from "../harness/reach.mjs";

const kId = "TP-01", kPath = `/api/v1/vehicles/${kId}`;
let hall, system, client, browser;

before(async () => {
  hall = await hallWith(kId, { agent: { seed: 22, timeFactor: 2, sensing: "analytic" } });
  ({ system, client, browser } = hall);
});
after(() => hall?.stop());

const untilIt = (condition, what) => client.untilVehicle(kId, condition, what, 60);

test("raised by 30 mm with two presses, held with one by a second operator, who is told whose it is", async () => {
  const page = await signedIn(browser, system, "operator", { path: `/vehicles/${kId}`, bypassCSP: true });
  await page.locator(".lifts > summary").click();
  const move = page.locator(".lifts .fields .cmd");
  await page.getByText("say a height").waitFor();
  await page.getByLabel("Height, mm").fill("high");
  await page.getByText("0 to 300 mm").waitFor();
  await page.getByLabel("Height, mm").fill("30");
  await page.getByText("Move to 30.0 mm").waitFor();
  await page.getByLabel("Speed, mm/s").fill("fast");
  await page.getByText("up to 10 mm/s").waitFor();
  await page.getByLabel("Speed, mm/s").fill("6");
  await move.click();
  await page.waitForTimeout(600);
  assert.equal((await client.get(kPath)).lift, undefined, "one press moves nothing");
  const asked = page.waitForRequest((request) => request.method() === "POST" && request.url().endsWith("/lifts"));
  await move.click();
  assert.deepEqual((await asked).postDataJSON(), { type: "setBracketHeight", bracket: "all", height_m: 0.03, speed_mps: 0.006 });
  await untilIt((v) => v.lift?.state === "under_way", "moves");
  await page.locator(".lifts .cmd", { hasText: "as operator wanted" }).waitFor();
  await picture(page, "lifts-moving");
  await untilIt((v) => v.lift.state === "done", "is there");
  await page.locator(".lifts > summary", { hasText: "30.0 mm" }).waitFor();
  assert.deepEqual(await faultsOf(page), []);

  await page.getByLabel("Height, mm").fill("200");
  await decide(page, move);
  await untilIt((v) => v.brackets[0].height_m > 0.04, "moves on");
  const other = await signedIn(browser, system, "operator", { path: `/vehicles/${kId}` });
  await other.locator(".lifts .feet .cmd", { hasText: "others still move" }).first().waitFor();
  await other.locator(".lifts > .hold").click();
  await untilIt((v) => v.lift.why === "lifts_stopped", "is held");
  await page.locator(".lifts .failed", { hasText: "A person held them" }).waitFor();
  await picture(page, "lifts-held");
  assert.deepEqual(page.errors, []);
  await other.context().close();
  await page.context().close();
});

for (const [width, height, lang, theme] of [[1024, 768, "zh", "dark"], [390, 844, "en", "light"]]) {
  test(`feet down and up at ${width} x ${height}: everything can be reached and read`, async () => {
    const page = await signedIn(browser, system, "operator", { path: `/vehicles/${kId}`, width, height, lang, theme, bypassCSP: true });
    const card = page.locator(".lifts");
    await card.waitFor();
    if (!(await card.evaluate((e) => e.open))) await card.locator("summary").click();
    const [lower, raise] = await card.locator(".feet .cmd").all();
    await lower.scrollIntoViewIfNeeded();
    await decide(page, lower);
    await untilIt((v) => v.lift?.type === "lowerParking" && v.lift.state === "done", "stands on its feet");
    await picture(page, `lifts-${width}-${lang}`);
    assert.deepEqual(await reachFaultsOf(page), []);
    assert.deepEqual(await overlapsOf(page), []);
    await decide(page, raise);
    await untilIt((v) => v.lift.type === "raiseParking" && v.lift.state === "done", "has raised its feet");
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}

test("sent while it stands on its feet, and parked where it arrives: raised first, lowered after, in one order", async () => {
  await client.post(`${kPath}/lifts`, { type: "lowerParking" });
  await untilIt((v) => v.lift?.type === "lowerParking" && v.lift.state === "done", "stands on its feet");
  const page = await signedIn(browser, system, "operator", { path: "/send" });
  await page.goto(`${system.url}/send?vehicle=${kId}&station=1`);
  await page.getByText(/Raised before it leaves: 0\.1\d.m out/).waitFor({ timeout: 20_000 });
  await page.getByText("Lower its feet on arrival").click();
  await page.getByText("It raises its feet first.").waitFor();
  await page.getByText("On arrival it lowers its feet.").waitFor();
  await picture(page, "send-parked");
  const start = page.getByRole("button", { name: /Start move/ });
  await until("start can be armed", async () => (await start.getAttribute("aria-disabled")) !== "true", { timeout_s: 20, every_ms: 100 });
  await page.getByRole("button", { name: /Arm/ }).click();
  await page.getByText(/[1-7] s left/).waitFor();
  await start.click();
  const order = await until("the order is stored", async () => (await client.get(`/api/v1/job-orders?vehicle=${kId}`)).items[0], { timeout_s: 10, every_ms: 50 });
  assert.deepEqual([order.steps[0].before, order.steps[0].after].map((list) => list.map((a) => a.type)), [["raiseParking"], ["lowerParking"]]);
  assert.equal((await client.untilEnded(order.id, 180)).state, "Ended");
  const parked = await client.get(kPath);
  assert.ok(parked.parking_feet.every((foot) => foot.extension_m > 0.1), JSON.stringify(parked.parking_feet));
  assert.deepEqual(page.errors, []);
  await page.context().close();
});
