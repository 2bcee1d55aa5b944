// Every screen on a wall screen, a laptop, a tablet and a phone, in both languages and themes, in a hall full of trouble: nothing out of reach,
// nothing that axe finds, no console error, and no word that is no person's or is of the other language, on the map's canvas neither.
// PULSELINE_WALK=full asks axe about each screen in each language and theme, else in one of the four a size, in turn, so that the
// sizes together have both of each.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { until } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";
import { faultsOfWords, rememberPaint, wordsOf } from "../harness/crawl.mjs";
import { overlapsOf, reachFaultsOf } from "../harness/reach.mjs";
import { kWalker, startTroubledHall } from "./walk_hall.mjs";
import { pausedScreens, screensOf } from "./walk_screens.mjs";

const kFull = process.env.PULSELINE_WALK === "full";
const kOnly = process.env.PULSELINE_WALK_ONLY && new RegExp(process.env.PULSELINE_WALK_ONLY); // for who mends one screen
const kOnlyWidth = Number(process.env.PULSELINE_WALK_WIDTH ?? 0);
const kSizes = [[1920, 1080], [1280, 800], [1024, 768], [390, 844]].filter(([width]) => kOnlyWidth === 0 || width === kOnlyWidth);
const kLooks = [["en", "light"], ["zh", "dark"], ["en", "dark"], ["zh", "light"]];

let hall, browser, allowed;
const count = { screens: 0, looks: 0, texts: 0 };

before(async () => {
  hall = await startTroubledHall();
  allowed = allowedOf(hall);
  browser = await startBrowser();
});
after(async () => {
  console.log(`${count.screens} screens at their sizes, ${count.looks} times asked by axe, ${count.texts} texts read`);
  await browser?.close();
  await hall?.system.stop();
});

/** What is the same in both languages. Each has its reason; nothing else may be. */
const programOf = (order) => order.created_by.replace("token:", "").slice(0, 6);
function allowedOf({ orders, system: { plant: { model } } }) {
  // A name in Chinese may hold a word of its own: "C iGPS 工作区".
  const named = [...model.halls, ...model.stations, ...model.areas, ...model.vehicle_types];
  const inNames = named.flatMap(({ names }) => [...(names?.zh ?? "").matchAll(/[A-Za-z]{2,}/g)].map(([word]) => word));
  return [
    "Pulseline", kWalker,
    ...model.vehicles.flatMap((v) => [v.id, v.name]),
    ...(model.loads ?? []).flatMap((load) => [load.id, load.name, load.model ?? ""]),
    ...model.markers.map((marker) => marker.payload),
    ...(model.transmitters ?? []).map(({ id }) => id), // painted where the map is close enough
    ...inNames,
    programOf(orders.done), // the beginning of a token's id
    /JO-\d+/, // orders are called so on the floor
    "MES", // the system that gives orders, called so in both languages
    "mm", "km", "m/s", "kN", "kg", "min", "px", "dx", "dy", // units and symbols of quantities
    "PDF", "SVG", // kinds of files
  ];
}

/** Goes to an address as Back and Forward do, without loading the page anew. */
async function goTo(page, path) {
  const show = (address) => page.evaluate((to) => {
    history.pushState(null, "", to);
    dispatchEvent(new PopStateEvent("popstate"));
  }, address);
  await show("/elsewhere"); // so that what is open and chosen on the page before is gone
  await drawn(page);
  await show(path);
}

/** Turns language and theme by the header's own buttons, pressed as a screen reader presses them: an open panel stays open. */
async function turn(page, language, theme) {
  await page.evaluate(([lang, look]) => {
    document.querySelector(`.lang [lang|=${lang}]`).click();
    if (document.documentElement.dataset.theme !== look) document.querySelector(".theme button").click();
  }, [language, theme]);
  await page.waitForFunction(([lang, look]) => document.documentElement.lang.startsWith(lang) && document.documentElement.dataset.theme === look, [language, theme]);
  await drawn(page);
}
/** Two frames: what was changed is laid out and painted. */
const drawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

async function settled(page, screen) {
  await page.locator(screen.ready).first().waitFor({ state: "attached", timeout: 20_000 });
  await until(`${screen.name} has its data`, async () => (await page.locator(".sk, .loading").count()) === 0 && (await page.locator(".page").innerText()).length > 25, { timeout_s: 15, every_ms: 40 });
  await drawn(page);
}

async function look(page, screen, axeLooks, problems) {
  const note = (found, what) => problems.push(...found.map((fault) => `${screen.name}, ${what}: ${fault}`));
  await goTo(page, screen.path);
  await settled(page, screen);
  await screen.open?.(page);
  ++count.screens;
  for (const language of ["en", "zh"]) {
    const themes = axeLooks.filter(([lang]) => lang === language).map(([, theme]) => theme);
    for (const theme of themes.length > 0 ? themes : [await page.evaluate(() => document.documentElement.dataset.theme)]) {
      await turn(page, language, theme);
      if (theme === (themes[0] ?? theme)) {
        await screen.keep?.(page);
        const words = await wordsOf(page);
        count.texts += words.length;
        note(faultsOfWords(words, allowed), "words");
        if (themes.length > 0) await picture(page, `walk-${screen.name.replaceAll(/\W+/g, "-")}-${page.viewportSize().width}-${theme}-${language}`);
        await screen.keep?.(page);
        note(await overlapsOf(page), `${language}, words over each other`);
        note(await reachFaultsOf(page, { within: screen.within }), `${language}, reach`);
      }
      if (themes.length === 0) continue;
      await screen.keep?.(page);
      note(await faultsOf(page), `${language}, ${theme}, axe`);
      ++count.looks;
    }
  }
  await screen.closed?.(page);
}

/** One screen that cannot be walked is one problem: the others are walked all the same. */
async function tried(page, screen, axeLooks, problems) {
  try {
    await look(page, screen, axeLooks, problems);
  } catch (error) {
    await picture(page, `walk-failed-${screen.name.replaceAll(/\W+/g, "-")}-${page.viewportSize().width}`);
    problems.push(`${screen.name}: ${error.message.split("\n").slice(0, 4).join(" ")}`);
  }
}

async function walk(size, screens) {
  const [width, height] = kSizes[size];
  const page = await signedIn(browser, hall.system, kWalker, { width, height, init: rememberPaint });
  page.on("console", (message) => message.type() === "error" && page.errors.push(message.text()));
  const problems = [];
  for (const [index, screen] of screens.entries()) {
    if ((screen.only && !screen.only(page)) || (kOnly && !kOnly.test(screen.name))) continue;
    await tried(page, screen, kFull ? kLooks : [kLooks[(index + size) % kLooks.length]], problems);
  }
  assert.deepEqual(problems, []);
  assert.deepEqual(page.errors, []);
  await page.context().close();
}

kSizes.forEach(([width, height], size) => test(`every screen at ${width} x ${height}`, () => walk(size, screensOf(hall))));

test("the fleet is paused", async () => {
  await hall.client.post("/api/v1/fleet/pause");
  await hall.client.untilVehicle("DL-01", (v) => v.activity === "paused", "stands");
});
kSizes.forEach(([width, height], size) => test(`the paused fleet at ${width} x ${height}`, () => walk(size, pausedScreens(hall))));

for (const [[width, height], [lang, theme]] of kSizes.map((size, i) => [size, kLooks[i]])) {
  test(`sign-in at ${width} x ${height}, ${lang}, ${theme}`, async () => {
    const page = await (await browser.newContext({ viewport: { width, height } })).newPage();
    await page.goto(`${hall.system.url}/orders?lang=${lang}&theme=${theme}`);
    await page.locator("input[name=username]").fill(kWalker);
    await page.locator("input[type=password]").fill("wrong-password");
    const problems = [];
    for (const what of ["asked", "refused"]) {
      if (what === "refused") {
        await page.locator("button[type=submit]").click();
        await page.locator(".error svg").waitFor();
      }
      problems.push(...faultsOfWords(await wordsOf(page), allowed), ...(await reachFaultsOf(page, { pause: false })), ...(await faultsOf(page)));
    }
    await picture(page, `walk-signin-${width}-${theme}-${lang}`);
    assert.deepEqual(problems, []);
    await page.context().close();
  });
}

kSizes.forEach(([width, height], size) => test(`the link is cut at ${width} x ${height}`, async () => {
  const page = await signedIn(browser, hall.system, kWalker, { width, height, init: rememberPaint });
  await page.locator(".veh[data-vehicle]").first().waitFor({ state: "attached" });
  for (const path of ["/vehicles/DL-01", "/send?vehicle=OM-01&station=29"]) {
    await goTo(page, path); // what it is made of comes before the link is cut
    await page.locator(".card").first().waitFor();
  }
  await page.context().setOffline(true);
  await page.evaluate(() => dispatchEvent(new Event("offline")));
  if (size === kSizes.length - 1) await hall.system.kill(hall.system.server);
  const problems = [];
  await page.locator(".app[data-link=lost]").waitFor({ timeout: 15_000 });
  for (const screen of [
    { name: "cut: map", path: "/map", ready: ".veh.old" },
    { name: "cut: vehicle", path: "/vehicles/DL-01", ready: ".chips.old" },
    { name: "cut: send", path: "/send?vehicle=OM-01&station=29", ready: ".card" },
  ]) {
    await tried(page, screen, kFull ? kLooks : [kLooks[size]], problems);
  }
  assert.deepEqual(problems, []);
  await page.context().close();
}));
