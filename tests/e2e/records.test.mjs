// The lists and pages of stops, orders and stations, in Chromium against the real server and real agents: rows that are links, pictures
// of small deviations, a search, and the words for an order that a person cancelled.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";
import { rememberPaint, wordsOf } from "../harness/crawl.mjs";

const SIZES = [[1920, 1080, "en", "light"], [1024, 768, "zh", "dark"], [390, 844, "en", "dark"]];
let system, client, browser, stops, cancelled;

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles(["TP-01", "MV-01"]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  system.startAgent("TP-01", { seed: 61, timeFactor: 6, sensing: "analytic" });
  await client.untilReady("TP-01");
  const tour = await client.order("TP-01", [2, 3, 2, 3]);
  cancelled = await client.order("TP-03", [5]); // TP-03 never connects, so it waits
  browser = await startBrowser();
  assert.equal((await client.untilEnded(tour.id)).state, "Ended");
  stops = await client.stops(tour.id);
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

test("a row of a list is one link, pressed anywhere, opened with Enter and in a new tab", async () => {
  for (const [width, height, lang, theme] of SIZES) {
    const page = await signedIn(browser, system, "operator", { width, height, lang, theme, bypassCSP: true });
    for (const [path, of] of [["/records", stops.at(-1).id], ["/orders", cancelled.id]]) {
      const list = system.url + path, one = `${list}/${of}`;
      const link = page.locator(`a[href="${path}/${of}"]`);
      const row = page.locator(".rows tr", { has: link });
      await page.goto(list);
      await link.waitFor();
      assert.equal(await row.locator("a, button, input, select, [tabindex]").count(), 1, `${path}: nothing else in the row is pressed`);

      const cell = await row.locator("td:visible").last().boundingBox();
      await page.mouse.click(cell.x + cell.width / 2, cell.y + cell.height / 2);
      await page.waitForURL(one);

      await page.goBack();
      await link.focus();
      await page.keyboard.press("Enter");
      await page.waitForURL(one);

      await page.goBack();
      await link.waitFor();
      for (const options of [{ modifiers: ["Control"] }, { button: "middle" }]) {
        const { width: wide, height: high } = await row.boundingBox();
        const opened = page.context().waitForEvent("page");
        await row.click({ ...options, position: { x: wide - 12, y: high / 2 } });
        const tab = await opened;
        await tab.waitForURL(one);
        await tab.close();
        assert.equal(page.url(), list, "the list stays where it is");
      }
      assert.deepEqual(await faultsOf(page), [], `${path}, ${width}: accessibility`);
      await link.focus();
      await picture(page, `row-link${path.replace("/", "-")}-${width}-${theme}-${lang}`);
    }
    assert.deepEqual(page.errors, []);
    await page.context().close();
  }
});

test("stops of less than a millimetre are shown close up, with words and a picture for where the tolerance lies", async () => {
  const reach = Math.max(...stops.flatMap((s) => [Math.abs(s.dx_m), Math.abs(s.dy_m)])) * 1000;
  const half = [1, 2, 5].find((h) => h >= reach * 1.05);
  assert.ok(half !== undefined, `stops of this seed reach ${reach} mm`);
  for (const [width, height, lang, theme] of SIZES) {
    const [close, tolerance, words] = lang === "en" ? ["Close-up", "Tolerance", "tolerance ±25 mm lies outside this picture"] : ["放大", "公差", "公差 ±25 mm 在图外"];
    const page = await signedIn(browser, system, "operator", { width, height, lang, theme, bypassCSP: true });
    await page.goto(`${system.url}/records/${stops.at(-1).id}`);
    const target = page.locator(".tgt");
    const pressed = (card, name) => card.getByRole("button", { name, pressed: true });
    /** How far from the middle the farthest of the earlier stops is drawn, as a share of the plot's half width. */
    const drawn = () => target.locator(".tfr").evaluate((frame) => {
      const box = frame.getBoundingClientRect();
      const dots = [...frame.parentElement.querySelectorAll(".tdot, .tcur")].map((dot) => dot.getBBox());
      const view = frame.getBBox().width / 2;
      return { share: Math.max(...dots.flatMap((b) => [b.x, b.y, b.x + b.width, b.y + b.height].map(Math.abs))) / view, px: box.width };
    });
    await target.getByText(lang === "en" ? `last ${stops.length} stops` : `最近 ${stops.length} 次`).waitFor();
    await pressed(target, `${close} ±${half} mm`).waitFor();
    await target.getByText(words).waitFor();
    await target.locator(".locator", { hasText: "±25 mm" }).waitFor();
    const near = await drawn();
    const share = reach / half;
    assert.ok(Math.abs(near.share - share) < 0.02, `the farthest stop is drawn at ${near.share} of the close-up, not at ${share}`);
    assert.ok(near.px > 150, "and it is a picture, not a stamp");
    await picture(page, `record-close-${width}-${theme}-${lang}`);
    assert.deepEqual(await faultsOf(page), [], `${width}: accessibility`);

    await target.getByRole("button", { name: tolerance }).click();
    await pressed(target, `${tolerance} ±25 mm`).waitFor();
    await target.locator(".locator").waitFor({ state: "detached" });
    assert.equal(await target.getByText(words).count(), 0);
    assert.ok(Math.abs((await drawn()).share - reach / 30) < 0.02, "the same stops, as small as they are against the tolerance");
    await picture(page, `record-tolerance-${width}-${theme}-${lang}`);

    if (width < 1536) await page.getByRole("tab").last().click();
    const trend = page.locator(".trds");
    await pressed(trend, tolerance).waitFor();
    await trend.getByRole("button", { name: close }).click();
    const row = trend.locator(".trd").first();
    await row.locator(".high", { hasText: /\+\d+.*↑ \+25/s }).waitFor();
    await row.locator(".low", { hasText: /↓ −25.*−\d+/s }).waitFor();
    assert.equal(await row.locator(".ttol").count(), 0, "no line where the tolerance is not");
    await trend.getByRole("button", { name: tolerance }).click();
    await row.locator(".ttol").waitFor({ state: "attached" });
    await picture(page, `record-trend-${width}-${theme}-${lang}`);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  }
});

test("a stop that was not measured comes into the list of records, with its reason, and can be asked for alone", async () => {
  const pages = [];
  for (const [width, height, lang, theme] of SIZES) {
    const page = await signedIn(browser, system, "operator", { width, height, lang, theme, bypassCSP: true });
    await page.goto(`${system.url}/records`);
    await page.locator(".rows tr", { has: page.locator(`a[href="/records/${stops.at(-1).id}"]`) }).waitFor();
    pages.push([page, lang, `${width}-${theme}-${lang}`]);
  }
  system.startAgent("MV-01", { seed: 61, timeFactor: 6, extra: ["--fault", "marker-lost@1"] });
  await client.untilReady("MV-01");
  const order = await client.order("MV-01", [13]);
  await client.untilOrder(order.id, (o) => o.state === "Interrupted", "is interrupted");
  const { items } = await client.get("/api/v1/unmeasured-stops?vehicle=MV-01&station=13");
  assert.ok(items.length > 0 && items.every((event) => event.order === order.id));
  for (const [page, lang, name] of pages) {
    const [words, reason, count] = lang === "en"
      ? ["Not measured", /The stop at station 13 could not be measured: /, `${items.length} not measured`]
      : ["未测量", /13 号站的停站未能测量：/, `${items.length} 次未测量`];
    const rows = page.locator(".rows tr", { has: page.locator(`a[href="/orders/${order.id}"]`) });
    await rows.first().waitFor({ timeout: 10_000 }); // nobody has loaded the page again
    await until("each of them is a row", async () => (await rows.count()) === items.length, { timeout_s: 10, every_ms: 50 });
    assert.match(await rows.first().innerText(), reason);
    await rows.first().getByText(words, { exact: true }).waitFor();
    await page.getByText(count).first().waitFor();
    await picture(page, `records-unmeasured-${name}`);
    await page.getByLabel(lang === "en" ? "Result" : "结果").selectOption("unmeasured");
    await page.locator(`a[href="/records/${stops.at(-1).id}"]`).waitFor({ state: "detached" });
    assert.equal(await rows.count(), items.length);
    assert.deepEqual(await faultsOf(page), []);
    await rows.first().click();
    await page.waitForURL(`**/orders/${order.id}`);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  }
});

test("stations are found by number, name and zone in the language of the page", async () => {
  for (const [lang, name, zone, label, none] of [["en", "Jig south 2", "Pulse line", "Number, name or zone", "No station fits"], ["zh", "南侧型架 2", "脉动生产线", "站号、名称或区域", "没有符合的站点"]]) {
    const page = await signedIn(browser, system, "operator", { lang, path: "/stations" });
    const field = page.getByLabel(label);
    const shown = page.locator(".tile .num");
    const numbers = async (text, expected) => {
      await field.fill(text);
      await until(`${text}: ${expected}`, async () => JSON.stringify(await shown.allInnerTexts()) === JSON.stringify(expected), { timeout_s: 5, every_ms: 30 });
    };
    await numbers("28", ["28"]);
    await numbers(name, ["28"]);
    await field.fill(zone);
    await until("those of the pulse line", async () => (await shown.count()) > 1 && (await shown.count()) < 40, { timeout_s: 5, every_ms: 30 });
    assert.deepEqual([...new Set(await page.locator(".tile .zone-name").allInnerTexts())], [`A ${zone}`], "each says its zone");
    await picture(page, `stations-found-${lang}`);
    await field.fill("nowhere");
    await page.getByText(none).waitFor();
    await field.fill("");
    await until("all of them", async () => (await shown.count()) === 40, { timeout_s: 5, every_ms: 30 });
    assert.deepEqual(page.errors, []);
    await page.context().close();
  }
});

test("an order that a person cancelled is called Cancelled wherever people see it, and Aborted by the API", async () => {
  const page = await signedIn(browser, system, "operator", { init: rememberPaint });
  await page.goto(`${system.url}/send?order=${cancelled.id}`);
  await page.locator(".confirm .say", { hasText: "Waiting" }).waitFor();
  await page.locator(".confirm .cmd", { hasText: "Cancel order" }).click();
  await page.locator(".confirm .cmd[data-state=armed]").getByText(/[1-7] s/).waitFor();
  await page.locator(".confirm .cmd[data-state=armed]").click();
  assert.equal((await client.untilEnded(cancelled.id)).state, "Aborted");
  for (const [lang, word, never] of [["en", "Cancelled", /abort/i], ["zh", "已取消", /中止|终止/]]) {
    const reader = lang === "en" ? page : await signedIn(browser, system, "operator", { lang, init: rememberPaint });
    for (const [path, place] of [[`/send?order=${cancelled.id}`, ".confirm .say"], ["/orders", ".rows tr"], [`/orders/${cancelled.id}`, ".odetail .ans1"]]) {
      await reader.goto(system.url + path);
      await reader.locator(place, { hasText: lang === "zh" && path.endsWith(cancelled.id) && path.startsWith("/orders") ? "取消" : word }).first().waitFor();
      await picture(reader, `cancelled${path.split("?")[0].replaceAll("/", "-").slice(0, 8)}-${lang}`);
      assert.deepEqual((await wordsOf(reader)).filter(({ text }) => never.test(text)), [], `${path}, ${lang}`);
    }
    await reader.goto(`${system.url}/map`);
    await reader.locator(".strip, .veh[data-vehicle]").first().waitFor({ state: "attached" });
    assert.deepEqual((await wordsOf(reader)).filter(({ text }) => never.test(text)), [], `map, ${lang}`);
    assert.deepEqual(reader.errors, []);
    if (reader !== page) await reader.context().close();
  }
  await page.context().close();
});
