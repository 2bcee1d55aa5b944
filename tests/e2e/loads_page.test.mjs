// The loads of a plant on a screen of their own, in Chromium against the real server and a real agent: one aircraft on the platform, one
// hanging at station 0. Where each is, since when and by whom, its drawing, where it has been, and a person who says where it is.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { variantOf } from "../harness/plants.mjs";
import { hallWith } from "../harness/one_vehicle.mjs";
import { System, until } from "../harness/processes.mjs";
import { decide, faultsOf, picture, signedIn } from "../harness/browser.mjs";
import { overlapsOf, reachFaultsOf } from "../harness/reach.mjs";

const kId = "TP-01", kCarried = "A-101", kHung = "A-102";
let hall, system, client, browser;

before(async () => {
  hall = await hallWith(kId, { agent: { seed: 22, timeFactor: 4, sensing: "analytic" } });
  ({ system, client, browser } = hall);
});
after(() => hall?.stop());

const say = async (load, body) => {
  const answer = await client.request("PUT", `/api/v1/loads/${load}/place`, { body });
  assert.equal(answer.status, 202, JSON.stringify(answer.body));
};
async function sound(page) {
  assert.deepEqual(await reachFaultsOf(page), []);
  assert.deepEqual(await overlapsOf(page), []);
  assert.deepEqual(await faultsOf(page), []);
  assert.deepEqual(page.errors, []);
}

const kWays = [
  { width: 1920, height: 1080, lang: "en", theme: "light", nav: "Loads", carried: "TP-01", hung: "Station 0", none: "It has not been moved yet" },
  { width: 1920, height: 1080, lang: "zh", theme: "dark", nav: "载荷", carried: "TP-01", hung: "0 号站", none: "尚未移动过" },
  { width: 1024, height: 768, lang: "zh", theme: "light", nav: "载荷", carried: "TP-01", hung: "0 号站", none: "尚未移动过" },
  { width: 390, height: 844, lang: "en", theme: "dark", nav: "Loads", carried: "TP-01", hung: "Station 0", none: "It has not been moved yet" },
];
for (const { width, height, lang, theme, nav, carried, hung, none } of kWays) {
  test(`the list, and one of it, at ${width} x ${height} in ${lang}`, async () => {
    const page = await signedIn(browser, system, "operator", { width, height, lang, theme, bypassCSP: true });
    await page.locator(".rail").getByRole("link", { name: nav }).click();
    const rowOf = (load) => page.locator(".rows tr", { hasText: load });
    await rowOf(kCarried).getByRole("link", { name: carried }).waitFor();
    await rowOf(kHung).getByRole("link", { name: hung }).waitFor();
    await picture(page, `loads_page-list-${width}-${lang}-${theme}`);
    await sound(page);

    await page.locator(".rows").getByRole("link", { name: kHung }).click();
    await page.getByRole("heading", { level: 1, name: kHung }).waitFor();
    await page.locator(".lmoves", { hasText: none }).waitFor();
    assert.equal(await page.locator(".lpaper .lbracket").count(), 4);
    await picture(page, `loads_page-hung-${width}-${lang}-${theme}`);
    await sound(page);
    await page.context().close();
  });
}

test("who sees that an aircraft is elsewhere says so with two presses, and every page knows it at once, with whose word it is", async () => {
  const page = await signedIn(browser, system, "operator", { path: `/loads/${kHung}`, lang: "en", bypassCSP: true });
  const other = await signedIn(browser, system, "viewer", { path: "/loads", lang: "en", bypassCSP: true });
  const row = other.locator(".rows tr", { hasText: kHung });
  await row.getByRole("link", { name: "Station 0" }).waitFor();

  await page.getByRole("button", { name: "It is elsewhere" }).click();
  assert.equal(await page.getByRole("button", { name: "On TP-01" }).count(), 0, "it carries another");
  await page.locator(".lplaces").getByRole("button", { name: "At station 7" }).click();
  await picture(page, "loads_page-say-1920-en");
  await decide(page, page.locator(".lform .cmd"));
  await page.locator(".lwhere .ans1", { hasText: "Station 7" }).waitFor();
  assert.equal((await client.get(`/api/v1/loads/${kHung}`)).by, "operator");
  await page.locator(".lmoves tbody tr", { hasText: "Station 0" }).filter({ hasText: "operator" }).waitFor();
  await row.getByRole("link", { name: "Station 7" }).waitFor();
  await row.filter({ hasText: "operator" }).waitFor();

  await say(kHung, {}); // another program, while both look
  await page.locator(".lwhere .ans1", { hasText: "Not in the plant" }).waitFor();
  await until("the history has both, newest first", async () => (await page.locator(".lmoves tbody tr").count()) === 2);
  assert.match(await page.locator(".lmoves tbody tr").first().innerText(), /Station 7\s+Not in the plant/);
  await row.filter({ hasText: "Not in the plant" }).waitFor();
  await picture(page, "loads_page-moved-1920-en");
  await sound(page);

  await other.locator(".rows").getByRole("link", { name: kHung }).click();
  await other.locator(".lmoves tbody tr").first().waitFor();
  assert.equal(await other.getByRole("button", { name: "It is elsewhere" }).count(), 0, "a viewer says nothing");
  await page.context().close();
  await other.context().close();
});

test("its name leads to it from the vehicle, the station and Send", async () => {
  await say(kHung, { station: 0 });
  const page = await signedIn(browser, system, "operator", { path: `/vehicles/${kId}`, lang: "en", bypassCSP: true });
  const leads = async (path, place, load) => {
    await page.goto(system.url + path);
    await page.locator(place).getByRole("link", { name: load }).first().click();
    await page.getByRole("heading", { level: 1, name: load }).waitFor();
  };
  await leads(`/vehicles/${kId}`, ".chips", kCarried);
  await leads("/vehicles", ".rows", kCarried);
  await leads("/stations", ".tile", kHung);
  await leads(`/send?vehicle=${kId}`, ".vrow", kCarried);
  await leads(`/map?vehicle=${kId}`, ".vcard", kCarried);
  await page.goto(`${system.url}/loads/${kHung}`);
  await page.locator(".lwhere .ans1").getByRole("link", { name: "Station 0" }).click();
  await page.locator(".tile", { hasText: kHung }).waitFor();
  assert.equal(await page.locator(".tile").count(), 1, "the board shows that station");
  await page.goto(`${system.url}/loads/nothing`);
  await page.getByText("There is no load nothing").waitFor();
  await page.getByRole("link", { name: "All loads" }).click();
  await page.locator(".rows tr", { hasText: kCarried }).waitFor();
  assert.deepEqual(page.errors, []);
  await page.context().close();
});

test("a plant without loads says what would be here", async () => {
  const empty = await System.create(variantOf("pulse-line", (model) => (model.loads = [])));
  try {
    await empty.startServer();
    const page = await signedIn(browser, empty, "operator", { path: "/loads", lang: "en", bypassCSP: true });
    await page.getByText("No loads in this plant").waitFor();
    await picture(page, "loads_page-empty-1920-en");
    await sound(page);
    await page.context().close();
  } finally {
    await empty.stop();
  }
});
