// Every page on a wall screen, a tablet and a phone, in both languages and both themes: no sideways scroll, Pause fleet in its corner,
// no command that is too small, cut off or covered, and nothing that axe finds.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";
import { reachFaultsOf } from "../harness/reach.mjs";

const VEHICLES = ["TP-01", "MV-01"];
const BROKEN = ["TP-02", "TP-03"]; // join for the last tests, which are about banners
let system, client, browser, stop, order;

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles([...VEHICLES, ...BROKEN]);
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
    assert.deepEqual(await brokenWords(page), []);
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

// A magnification of the browser leaves less room for the same screen: 200 % are half of it, at twice its pixels.
for (const [width, height, lang, magnification] of [[960, 540, "en", 2], [512, 384, "zh", 2], [844, 390, "en", 1]]) {
  const what = magnification === 2 ? `under a magnification of 200 %, ${2 * width} x ${2 * height}` : `on a phone held sideways, ${width} x ${height}`;
  test(`every page ${what}, ${lang}: all in reach, and the header has room for its words`, async () => {
    const page = await signedIn(browser, system, "operator", { width, height, lang, magnification });
    assert.deepEqual(await brokenWords(page), []);
    for (const [name, path] of pages()) {
      await page.goto(system.url + path);
      await page.locator("main .card, main .mappage").first().waitFor();
      await until("the data has come", async () => (await page.locator(".page").innerText()).length > 25, { timeout_s: 10, every_ms: 50 });
      await picture(page, `low-${name}-${width}-${lang}`);
      assert.deepEqual(await reachFaultsOf(page), [], name);
    }
    await page.context().close();
  });
}

/** What the header has no room for: words that go on in a second line, or run out of their cell. */
function brokenWords(page) {
  return page.locator(".shell :is(button, .cell, .plant > div)").evaluateAll((all) => all.filter((e) => e.checkVisibility()).filter((e) => {
    const lines = document.createRange();
    lines.selectNodeContents(e);
    const broken = e.childElementCount === 0 && new Set([...lines.getClientRects()].map((r) => Math.round(r.top))).size > 1;
    const next = e.closest(".shell > *").nextElementSibling;
    return broken || e.scrollWidth > e.clientWidth + 1 || (next?.checkVisibility() && next.offsetTop === e.offsetTop && lines.getBoundingClientRect().right > next.getBoundingClientRect().left + 1);
  }).map((e) => e.textContent));
}

test("battery, fields and mode of a vehicle stay at every width", async () => {
  const page = await signedIn(browser, system, "operator", { path: "/vehicles/TP-01" });
  for (const width of [1920, 1536, 1535, 1280, 1024, 720, 719, 390, 360]) {
    await page.setViewportSize({ width, height: 800 });
    for (const words of [/^\d+ %$/, "Fields clear", "Automatic"]) {
      const chip = page.locator(".vhead .chip", { hasText: words });
      await chip.waitFor();
      const seen = await chip.evaluate((e) => {
        const { left, right, top, height } = e.getBoundingClientRect();
        return left >= 0 && right <= innerWidth && e.scrollWidth <= e.clientWidth && e.contains(document.elementFromPoint((left + right) / 2, top + height / 2));
      });
      assert.ok(seen, `${words} at ${width} px`);
    }
  }
  await page.context().close();
});

// The three sizes are not all there are: a tablet held upright is 768 px wide, and a broken link takes more of the header.
test("Pause fleet is in its corner, and the language in reach, at every width, with a link and without", async () => {
  for (const lang of ["en", "zh"]) {
    const page = await signedIn(browser, system, "operator", { lang });
    for (const link of ["live", "lost"]) {
      if (link === "lost") {
        await page.context().setOffline(true);
        await page.evaluate(() => dispatchEvent(new Event("offline")));
        await page.locator(".app[data-link=lost]").waitFor({ timeout: 15_000 });
      }
      for (const width of [1920, 1536, 1535, 1280, 1024, 960, 959, 840, 839, 768, 720, 719, 390, 360]) {
        await page.setViewportSize({ width, height: 800 });
        const right = await page.locator("button.pause").evaluate((e) => e.getBoundingClientRect().right - innerWidth);
        assert.ok(Math.abs(right) <= 0.5, `${lang}, ${link}, ${width} px: Pause fleet ends ${right} px beside the edge`);
        const inHeader = await page.locator(".shell > .lang").isVisible();
        if (!inHeader) await page.locator(".who > button").click();
        assert.equal(await page.getByRole("button", { name: "中文" }).isVisible(), true, `${lang}, ${width} px: the language`);
        if (!inHeader) await page.locator(".who > button").click();
      }
    }
    await page.context().close();
  }
});

// Late: MV-01 is told that it stands where its numbers are longest.
test("the longest numbers of a pose leave the columns apart", async () => {
  await client.post("/api/v1/vehicles/MV-01/init-position", { ...(await client.get("/api/v1/vehicles/MV-01")).pose, x_m: 114.6, y_m: 57, heading_rad: Math.PI });
  await client.untilVehicle("MV-01", (v) => v.pose.x_m > 114, "stands where it was told");
  const page = await signedIn(browser, system, "operator", { path: "/vehicles/MV-01" });
  for (const width of [1920, 1280, 1024, 390]) {
    await page.setViewportSize({ width, height: 1080 });
    if (width < 1536) await page.getByRole("tab", { name: "Why and pose" }).click();
    await page.locator(".pvs", { hasText: "114,600" }).waitFor();
    const touching = await page.locator(".pvs .value").evaluateAll((all) => all.filter((e) => {
      const end = Math.max(...[...e.querySelectorAll(".val > *")].map((part) => part.getBoundingClientRect().right));
      return end > e.getBoundingClientRect().right - 4;
    }).map((e) => e.textContent));
    assert.deepEqual(touching, [], `at ${width} px`);
    await picture(page, `pose-${width}`);
  }
  await page.context().close();
});

// From here on two vehicles have a broken wheel, and after that the fleet is paused, too.
test("on a phone the most urgent alarm is whole in three lines, and its vehicle and the other alarms are a press away", async () => {
  for (const id of BROKEN) system.startAgent(id, { seed: 23, sensing: "analytic", extra: ["--fault", "wheel=front drive@1"] });
  for (const id of BROKEN) await client.untilVehicle(id, (v) => v.wheels.some((w) => w.fault !== ""), "has a broken wheel");
  for (const [lang, wheel, todo] of [
    ["en", "TP-02: Wheel front drive: fault of the steering drive", "Have the wheel looked at before it moves on."],
    ["zh", "TP-02：前驱动轮：转向驱动故障", "继续行驶前请检修该车轮。"],
  ]) {
    const page = await signedIn(browser, system, "operator", { width: 390, height: 844, lang, path: "/orders" });
    const banner = page.locator(".banner.high");
    await banner.getByText(wheel).waitFor();
    await banner.getByRole("button", { name: /^(1 more|另 1 项)$/ }).waitFor();
    const seen = await banner.evaluate((e) => {
      const words = document.createRange();
      words.selectNodeContents(e.querySelector(".txt"));
      const [text] = e.querySelectorAll(".txt");
      return { lines: new Set([...words.getClientRects()].filter((r) => r.width > 0).map((r) => Math.round(r.bottom / 9))).size, cut: text.scrollHeight > text.clientHeight + 1 || text.scrollWidth > text.clientWidth + 1, height: e.offsetHeight };
    });
    assert.ok(seen.lines <= 3 && !seen.cut && seen.height <= 3 * 18 + 14, JSON.stringify(seen));
    await picture(page, `banner-phone-${lang}`);
    await banner.getByRole("link").click();
    await page.locator(".vcard", { hasText: todo }).waitFor();
    await banner.getByRole("button").click();
    for (const id of BROKEN) await page.locator("main tr", { hasText: id }).waitFor();
    assert.deepEqual(await reachFaultsOf(page), []);
    await page.context().close();
  }
});

/** What of these is cut: by the screen, or by a box that scrolls. */
const cutOf = (locator) => locator.evaluateAll((all) => all.filter((e) => {
  const seen = { top: 0, bottom: innerHeight, left: 0, right: innerWidth };
  for (let box = e.parentElement; box !== null; box = box.parentElement) {
    if (getComputedStyle(box).overflow === "visible") continue;
    const r = box.getBoundingClientRect();
    Object.assign(seen, { top: Math.max(seen.top, r.top), bottom: Math.min(seen.bottom, r.bottom), left: Math.max(seen.left, r.left), right: Math.min(seen.right, r.right) });
  }
  const r = e.getBoundingClientRect();
  return r.height === 0 || r.top < seen.top - 1 || r.bottom > seen.bottom + 1 || r.left < seen.left - 1 || r.right > seen.right + 1;
}).map((e) => e.textContent));

test("beside a banner a load is drawn whole on a tablet, and a stop's record is on one wall screen", async () => {
  for (const [width, height, lang, path, parts, least] of [
    [1024, 768, "zh", "/vehicles/TP-01", ".pbox .bc", 4],
    [1024, 768, "en", "/vehicles/TP-01", ".pbox .bc", 4],
    [1920, 1080, "en", "/vehicles/TP-01", ".pbox .bc", 4],
    [1920, 1080, "en", `/records/${stop.id}`, ".tgt, .runcard tr", 3],
  ]) {
    const page = await signedIn(browser, system, "operator", { width, height, lang });
    await page.goto(system.url + path);
    await page.locator(".banner.high").waitFor();
    await page.locator(parts).nth(least - 1).waitFor();
    assert.deepEqual(await cutOf(page.locator(parts)), [], `${path} at ${width}, ${lang}`);
    await page.context().close();
  }
});

test("two banners on a tablet leave the pad of Send all its keys, and Start its place", async () => {
  await client.post("/api/v1/fleet/pause");
  for (const lang of ["en", "zh"]) {
    const page = await signedIn(browser, system, "operator", { width: 1024, height: 768, lang, path: "/send" });
    await page.goto(`${system.url}/send?vehicle=MV-01`);
    await page.locator(".banner.held").waitFor();
    await page.locator(".banner.high").waitFor();
    await page.locator(".key").first().waitFor();
    await picture(page, `banners-send-${lang}`);
    const hidden = await page.locator(".key, .confirm .btn").evaluateAll((all) => all.filter((e) => {
      const { left, right, top, bottom } = e.getBoundingClientRect();
      const inset = 4; // rounded corners
      const corners = [[left + inset, top + inset], [right - inset, top + inset], [left + inset, bottom - inset], [right - inset, bottom - inset]];
      return bottom - top < 76 || !corners.every(([x, y]) => e.contains(document.elementFromPoint(x, y)));
    }).map((e) => e.textContent || e.getAttribute("aria-label")));
    assert.deepEqual(hidden, [], "without scrolling");
    const place = await page.locator(".confirm .go").evaluate((e) => Math.round(innerWidth - e.getBoundingClientRect().right));
    assert.ok(place <= 24, `Start is at the right, ${place} px from the edge`);
    assert.deepEqual(await reachFaultsOf(page), []);
    await page.context().close();
  }
});
