// Taking an aircraft over and setting it down from the vehicle's page, in Chromium against the real server and a real agent:
// two presses each, at a desk, on a tablet and on a phone; the page shows what the brackets feel and who has the aircraft.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { morning } from "../harness/plants.mjs";
import { hallWith } from "../harness/one_vehicle.mjs";
import { decide, faultsOf, picture, signedIn } from "../harness/browser.mjs";
import { overlapsOf, reachFaultsOf } from "../harness/reach.mjs";

const kId = "TP-01", kLoad = "A-101";
let hall, system, client, browser;

before(async () => {
  hall = await hallWith(kId, { plant: morning(1, { height_m: 0.02 }), agent: { seed: 22, timeFactor: 4, sensing: "analytic" } }); // the platform stands empty below it
  ({ system, client, browser } = hall);
});
after(() => hall?.stop());

const untilIt = (condition, what) => client.untilVehicle(kId, condition, what, 90);

const kWays = [
  { width: 1920, height: 1080, lang: "en", theme: "light", take: "Take over A-101", set: "Set down A-101" },
  { width: 1024, height: 768, lang: "zh", theme: "dark", take: "接取 A-101", set: "放下 A-101" },
  { width: 390, height: 844, lang: "en", theme: "dark", take: "Take over A-101", set: "Set down A-101" },
];
for (const { width, height, lang, theme, take, set } of kWays) {
  test(`taken over and set down again with two presses each at ${width} x ${height}`, async () => {
    const page = await signedIn(browser, system, "operator", { path: `/vehicles/${kId}`, width, height, lang, theme, bypassCSP: true });
    const card = page.locator(".lifts");
    await card.waitFor();
    if (!(await card.evaluate((e) => e.open))) await card.locator("summary").click();
    await decide(page, page.locator(".lifts .cmd", { hasText: take }));
    await untilIt((v) => v.lift?.type === "pick" && v.lift.state === "under_way", "takes it over");
    await untilIt((v) => v.lift.state !== "under_way" && v.load === kLoad, "carries it");
    await page.locator(".lifts .cmd", { hasText: set }).waitFor();
    await page.locator(".chip", { hasText: kLoad }).first().waitFor();
    await picture(page, `loads-${width}-${lang}`);
    assert.deepEqual(await reachFaultsOf(page), []);
    assert.deepEqual(await overlapsOf(page), []);
    if (width === 1920) assert.deepEqual(await faultsOf(page), []);
    await decide(page, page.locator(".lifts .cmd", { hasText: set }));
    await untilIt((v) => v.lift.type === "drop" && v.lift.state === "done" && v.load === undefined, "has set it down");
    await page.locator(".lifts .cmd", { hasText: take }).waitFor();
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}

test("where an aircraft is after a transfer that nobody saw the end of, a person says with two presses", async () => {
  const say = async (body) => {
    const answer = await client.request("PUT", `/api/v1/loads/${kLoad}/place`, { body });
    assert.equal(answer.status, 202, JSON.stringify(answer.body));
  };
  const page = await signedIn(browser, system, "operator", { path: `/vehicles/${kId}`, width: 1024, height: 768, lang: "en", bypassCSP: true });
  const button = (name) => page.locator(".lifts .cmd", { hasText: name });
  await page.locator(".lifts").waitFor();
  assert.equal(await button("is on the support here").count(), 0, "nobody is asked while all is as known");

  await say({ vehicle: kId }); // it still hangs
  await page.locator(".lifts .failed", { hasText: "Say where it is" }).waitFor();
  await picture(page, "loads-said-1024-en");
  assert.deepEqual(await reachFaultsOf(page), []);
  assert.deepEqual(await overlapsOf(page), []);
  await decide(page, button("A-101 is on the support here"));
  await untilIt((v) => v.load === undefined && v.load_fault === undefined, "is empty as the brackets feel");
  assert.equal((await client.get(`/api/v1/loads/${kLoad}`)).station, 1);

  await decide(page, button("Take over A-101"));
  await untilIt((v) => v.lift.state !== "under_way" && v.load === kLoad, "carries it");
  await say({}); // it is still on the brackets
  await decide(page, button("A-101 is on the vehicle"));
  await untilIt((v) => v.load === kLoad && v.load_fault === undefined, "carries what it feels");
  await button("Set down A-101").waitFor();
  assert.deepEqual(page.errors, []);
  await page.context().close();
});
