// What is done at the stations of an order, chosen by clicks in Chromium against the real server and a real agent: an aircraft is
// taken over and stood on feet by a tour, and brought back and set down by Send. The order says it in words, in both languages.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { morning } from "../harness/plants.mjs";
import { hallWith } from "../harness/one_vehicle.mjs";
import { until } from "../harness/processes.mjs";
import { decide, faultsOf, picture, signedIn } from "../harness/browser.mjs";
import { overlapsOf, reachFaultsOf } from "../harness/reach.mjs";

const kId = "TP-01", kLoad = "A-101";
const kWays = [
  { width: 1920, height: 1080, lang: "en", theme: "light" },
  { width: 1024, height: 768, lang: "zh", theme: "dark" },
];
let hall, system, client, browser;

before(async () => {
  hall = await hallWith(kId, { plant: morning(1, { height_m: 0.02 }), agent: { seed: 22, timeFactor: 8, sensing: "analytic" } }); // the platform stands empty below it
  ({ system, client, browser } = hall);
});
after(() => hall?.stop());

const vehicle = () => client.get(`/api/v1/vehicles/${kId}`);
const newest = async () => (await client.get(`/api/v1/job-orders?vehicle=${kId}`)).items[0];
const typesOf = (step) => [step.before, step.after].map((list) => (list ?? []).map((action) => action.type));

/** A picture, and nothing on it that is out of reach, covered, or hard to read. */
async function looksRight(page, name) {
  await picture(page, name);
  assert.deepEqual(await reachFaultsOf(page), []);
  assert.deepEqual(await overlapsOf(page), []);
  assert.deepEqual(await faultsOf(page), []);
}

async function type(page, digits) {
  for (const digit of String(digits)) await page.locator(".pad").getByRole("button", { name: digit, exact: true }).click();
}

/** The tour of this test: an aircraft taken over at station 1, then brought to station 2 and stood on feet there. */
async function writeTour(page, { create, any, take, feet, add }) {
  await page.getByRole("button", { name: create }).click();
  const form = page.locator(".tour");
  await form.getByRole("button", { name: any }).waitFor();
  await form.getByRole("button", { name: kId, exact: true }).click();
  await type(form, 1);
  await form.getByRole("button", { name: take }).click();
  await form.getByRole("button", { name: add }).click();
  await type(form, 2);
  await form.getByRole("button", { name: feet }).click();
  return form;
}
const kEn = { create: "New order", any: "Any that can", add: "Add station", take: "Take over A-101", set: "Set down", feet: "Stand on feet" };
const kZh = { create: "新建任务", any: "任意可用车辆", add: "添加站点", take: "接取 A-101", set: "放下载荷", feet: "支脚着地" };

for (const { width, height, lang, theme } of kWays) {
  test(`what a tour does at its stations is chosen and said at ${width} x ${height}`, async () => {
    const words = lang === "en" ? kEn : kZh;
    const page = await signedIn(browser, system, "operator", { path: "/orders", width, height, lang, theme, bypassCSP: true });
    const form = await writeTour(page, words);
    const [first, second] = [form.locator(".tourlist > li").nth(0), form.locator(".tourlist > li").nth(1)];
    await first.getByText(words.take).waitFor(); // its row is not the active one any more
    await second.locator(".then", { hasText: words.feet }).waitFor();
    assert.equal(await second.getByRole("button", { name: words.set }).count(), 0, "nothing holds a load at station 2");
    const height_px = (await second.getByRole("button", { name: words.feet }).boundingBox()).height;
    assert.ok(height_px >= 48, `${height_px} px for a glove`);
    await form.locator("canvas").waitFor();

    await first.locator(".num").click();
    const [take, set] = [words.take, words.set].map((name) => first.getByRole("button", { name }));
    const pressed = () => Promise.all([take, set].map((button) => button.getAttribute("aria-pressed")));
    await set.click();
    assert.deepEqual(await pressed(), ["false", "true"]);
    await take.click();
    assert.deepEqual(await pressed(), ["true", "false"], "one of the two");
    await looksRight(page, `step-actions-tour-${width}-${lang}`);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}

test("a tour takes an aircraft over and stands on its feet where it brings it", async () => {
  const page = await signedIn(browser, system, "operator", { path: "/orders", bypassCSP: true });
  const form = await writeTour(page, kEn);
  await form.getByText(/^About [\d:]+ min in all$/).waitFor({ timeout: 20_000 });
  await decide(page, form.locator("button.cmd"));
  await page.waitForURL(/\/orders\/[0-9a-f-]{36}/);
  const order = await newest();
  assert.deepEqual(order.steps.map(typesOf), [[[], ["pick"]], [[], ["lowerParking"]]]);
  await page.getByText("After: Take over A-101").waitFor();
  await page.getByText("After: Feet down").waitFor();
  await client.untilVehicle(kId, (v) => v.load === kLoad, "carries it", 120);
  const ended = await client.untilEnded(order.id, 240);
  assert.equal(ended.state, "Ended", JSON.stringify(ended.reason));
  const stands = await vehicle();
  assert.equal(stands.load, kLoad);
  assert.equal(stands.at_station, system.plant.station(2).id);
  assert.ok(stands.parking_feet.every((foot) => foot.extension_m > 0.1), JSON.stringify(stands.parking_feet));
  await page.locator(".odetail [role=status]", { hasText: "Done" }).waitFor();
  await looksRight(page, "step-actions-order-1920-en");
  assert.deepEqual(page.errors, []);
  await page.context().close();
  const chinese = await signedIn(browser, system, "operator", { path: `/orders/${order.id}`, width: 1024, height: 768, lang: "zh", theme: "dark", bypassCSP: true });
  await chinese.getByText("到站后：接取 A-101").waitFor();
  await chinese.getByText("到站后：放下支脚").waitFor();
  await looksRight(chinese, "step-actions-order-1024-zh");
  await chinese.context().close();
});

const kSend = {
  en: { set: "Set down A-101 there", feet: "Lower its feet on arrival", says: "On arrival it sets down A-101." },
  zh: { set: "到站后放下 A-101", feet: "到站后放下支脚", says: "到站后放下 A-101。" },
};
for (const { width, height, lang, theme } of kWays) {
  test(`what is done on arrival is chosen and said in Send at ${width} x ${height}`, async () => {
    const words = kSend[lang];
    const page = await signedIn(browser, system, "operator", { path: "/send", width, height, lang, theme, bypassCSP: true });
    await page.goto(`${system.url}/send?vehicle=${kId}&station=1`);
    if (width < 1536) await page.locator(".s3 .chg").click({ timeout: 20_000 });
    const set = page.getByLabel(words.set), feet = page.getByLabel(words.feet);
    await set.waitFor({ timeout: 20_000 });
    assert.deepEqual([await set.isChecked(), await feet.isChecked()], [false, false]);
    await set.check();
    await page.locator(".say", { hasText: words.says }).waitFor({ timeout: 20_000 });
    await looksRight(page, `step-actions-send-${width}-${lang}`);

    await page.goto(`${system.url}/send?vehicle=${kId}&station=6`);
    if (width < 1536) await page.locator(".s3 .chg").click();
    await feet.waitFor();
    await until("station 6 parks", () => feet.isChecked(), { timeout_s: 10 });
    assert.equal(await set.count(), 0, "nothing holds a load there");
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}

test("sent back from its feet, it sets the aircraft down where it came from", async () => {
  const page = await signedIn(browser, system, "operator", { path: "/send", bypassCSP: true });
  await page.goto(`${system.url}/send?vehicle=${kId}&station=1`);
  await page.getByLabel("Set down A-101 there").check();
  await page.getByText("It raises its feet first.").waitFor({ timeout: 20_000 });
  const start = page.getByRole("button", { name: /Start move/ });
  await until("start can be armed", async () => (await start.getAttribute("aria-disabled")) !== "true", { timeout_s: 20, every_ms: 100 });
  const last = (await newest()).id;
  await page.getByRole("button", { name: /Arm/ }).click();
  await page.getByText(/[1-7] s left/).waitFor();
  await start.click();
  const order = await until("the order is stored", async () => { const found = await newest(); return found.id !== last && found; }, { timeout_s: 10, every_ms: 50 });
  assert.deepEqual(order.steps.map(typesOf), [[["raiseParking"], ["drop"]]]);
  const ended = await client.untilEnded(order.id, 240);
  assert.equal(ended.state, "Ended", JSON.stringify(ended.reason));
  const load = await client.get(`/api/v1/loads/${kLoad}`);
  assert.deepEqual([load.station, load.vehicle], [1, undefined]);
  assert.equal((await vehicle()).load, undefined);
  await page.locator(".move .arrival").waitFor(); // or the page moves under the click
  await page.getByRole("link", { name: "Show order" }).click();
  await page.getByText("Before: Feet up").waitFor();
  await page.getByText("After: Set down").waitFor();
  await looksRight(page, "step-actions-back-1920-en");
  assert.deepEqual(page.errors, []);
  await page.context().close();
});

const kBrackets = {
  en: { move: "Set brackets on arrival", wrong: "0 to 300 mm", off: "Its brackets do not reach that height", says: "On arrival: Brackets to 40 mm." },
  zh: { move: "到站后升降支架", wrong: "0 至 300 mm", off: "支架达不到该高度", says: "到站后：支架升降至 40 mm。" },
};
for (const { width, height, lang, theme } of kWays) {
  test(`how high its brackets go on arrival is written and said in Send at ${width} x ${height}`, async () => {
    const words = kBrackets[lang];
    const page = await signedIn(browser, system, "operator", { path: "/send", width, height, lang, theme, bypassCSP: true });
    await page.goto(`${system.url}/send?vehicle=${kId}&station=2`);
    if (width < 1536) await page.locator(".s3 .chg").click({ timeout: 20_000 });
    await page.getByLabel(words.move).check({ timeout: 20_000 });
    const field = page.locator(".bheight input");
    await field.fill("301");
    await page.locator(".bheight [role=alert]", { hasText: words.wrong }).waitFor();
    await page.locator(".confirm", { hasText: words.off }).waitFor();
    await looksRight(page, `step-actions-brackets-wrong-${width}-${lang}`);
    await field.fill("40");
    await page.locator(".say", { hasText: words.says }).waitFor({ timeout: 20_000 });
    assert.equal(await page.locator(".bheight [role=alert]").count(), 0);
    await looksRight(page, `step-actions-brackets-${width}-${lang}`);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}

test("a tour whose brackets go to a height: the row says what is wrong, then what is done; and it is done", async () => {
  const page = await signedIn(browser, system, "operator", { path: "/orders", bypassCSP: true });
  await page.getByRole("button", { name: "New order" }).click();
  const form = page.locator(".tour"), row = form.locator(".tourlist > li").first();
  await form.getByRole("button", { name: kId, exact: true }).click();
  await type(form, 2);
  await form.getByRole("button", { name: "Move brackets" }).click();
  await row.locator(".lab.bad", { hasText: "Say how high the brackets go" }).waitFor();
  await form.locator(".bheight input").fill("400");
  await row.locator(".lab.bad", { hasText: "The brackets do not reach that height" }).waitFor();
  assert.equal(await form.locator("button.cmd").getAttribute("data-state"), "not_possible");
  await form.locator(".bheight").getByRole("button", { name: "Front left" }).click();
  await form.locator(".bheight input").fill("12.5");
  await row.locator(".then", { hasText: "Bracket front left to 12.5 mm" }).waitFor();
  await form.locator(".bheight").getByRole("button", { name: "All in step" }).click();
  await form.locator(".bheight input").fill("40");
  await row.locator(".then", { hasText: "Brackets to 40 mm" }).waitFor();
  await form.getByText(/^About [\d:]+ min in all$/).waitFor({ timeout: 20_000 });
  await looksRight(page, "step-actions-brackets-tour-1920-en");
  await decide(page, form.locator("button.cmd"));
  await page.waitForURL(/\/orders\/[0-9a-f-]{36}/);
  const order = await newest();
  assert.deepEqual(order.steps[0].after, [{ type: "setBracketHeight", parameters: { bracket: "all", height_m: 0.04 } }]);
  const ended = await client.untilEnded(order.id, 240);
  assert.equal(ended.state, "Ended", JSON.stringify(ended.reason));
  for (const { name, height_m } of (await vehicle()).brackets) assert.ok(Math.abs(height_m - 0.04) < 0.001, `${name}: ${height_m} m`);
  await page.getByText("After: Brackets to 40 mm").waitFor();
  assert.deepEqual(page.errors, []);
  await page.context().close();
});
