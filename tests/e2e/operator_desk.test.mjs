// The page from which a person works a platform all day (Tang 2020, Fig. 12c), in Chromium against the real server and a real agent
// with rendered pictures: brackets with heights and forces, feet, wheels, codes and the steps by which they are found, beside the
// station, the motion mode and the start. Three sizes, two languages, two themes.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { decide, faultsOf, picture, signedIn } from "../harness/browser.mjs";
import { hallWith } from "../harness/one_vehicle.mjs";
import { until } from "../harness/processes.mjs";
import { overlapsOf, reachFaultsOf } from "../harness/reach.mjs";

const kId = "TP-01", kPath = `/api/v1/vehicles/${kId}`;
let hall, system, client, browser;

before(async () => {
  hall = await hallWith(kId, { agent: { seed: 22, timeFactor: 6 } });
  ({ system, client, browser } = hall);
});
after(() => hall?.stop());

const kEn = { way: "Way", platform: "Platform", cameras: "Cameras", lifts: "Brackets and feet", grey: "Grey", edges: "Edges", corners: "Corners", result: "Result" };
const kZh = { way: "路线", platform: "平台", cameras: "相机", lifts: "支架与支脚", grey: "灰度", edges: "边缘", corners: "角点", result: "结果" };
const open = async (how) => {
  const page = await signedIn(browser, system, "operator", { path: "/map", bypassCSP: true, ...how });
  await page.goto(`${system.url}/send?vehicle=${kId}&station=2`);
  return page;
};
const view = (page, name) => page.locator(".viewseg").getByRole("button", { name, exact: true }).click();
async function looksRight(page, name) {
  await picture(page, `desk-${name}`);
  assert.deepEqual(await overlapsOf(page), [], name);
  assert.deepEqual(await reachFaultsOf(page), [], name);
}
/** How many of a picture's pixels are dark, grey and bright, and its size, as the browser decoded it. */
const pixelsOf = (img) => img.evaluate((e) => {
  const canvas = Object.assign(document.createElement("canvas"), { width: e.naturalWidth, height: e.naturalHeight });
  const pen = canvas.getContext("2d");
  pen.drawImage(e, 0, 0);
  const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
  const shares = { dark: 0, grey: 0, bright: 0, blue: 0 };
  for (let i = 0; i < data.length; i += 4) {
    const [r, , b] = [data[i], data[i + 1], data[i + 2]];
    if (b - r > 60) ++shares.blue;
    else ++shares[r < 20 ? "dark" : r > 235 ? "bright" : "grey"];
  }
  const all = data.length / 4;
  return { width: canvas.width, height: canvas.height, ...Object.fromEntries(Object.entries(shares).map(([name, count]) => [name, count / all])) };
});

for (const { width, height, lang, theme } of [
  { width: 1920, height: 1080, lang: "en", theme: "light" },
  { width: 1024, height: 768, lang: "zh", theme: "dark" },
  { width: 390, height: 844, lang: "en", theme: "dark" },
]) {
  test(`loads, heights, wheels and codes can be read beside the way at ${width} x ${height}`, async () => {
    const words = lang === "en" ? kEn : kZh;
    const page = await open({ width, height, lang, theme });
    const vehicle = await client.get(kPath);
    await view(page, words.platform);
    await page.waitForURL(/view=platform/);
    const cards = page.locator(".bodyview .bc");
    await cards.nth(3).waitFor();
    const shown = await cards.allInnerTexts();
    vehicle.brackets.forEach((b, i) => { // its height, its force and those of its two pins, whose cells tremble
      const told = [1000 * b.height_m, ...[b.force_a_n + b.force_b_n, b.force_a_n, b.force_b_n].map((n) => n / 1000)];
      const read = shown[i].match(/-?\d+\.\d/g).map(Number);
      assert.equal(read.length, 4, shown[i]);
      told.forEach((value, k) => assert.ok(Math.abs(read[k] - value) < 0.6, `${b.name}: ${shown[i]} is not ${told}`));
    });
    assert.ok((await page.locator(".bodyview .wl b").count()) >= vehicle.wheels.length, "each wheel has its words");
    await looksRight(page, `platform-${width}-${lang}-${theme}`);
    if (width === 1920) assert.equal(await page.locator(".bodyview .cam").count(), 2, "cameras below, where there is room");

    await view(page, words.cameras);
    for (const code of ["ST01-F", "ST01-B"]) await page.locator(".cam .chip", { hasText: code }).waitFor();
    const front = page.locator(".bodyview .cam").first();
    const img = front.locator("img");
    await img.waitFor();
    const result = await pixelsOf(img);
    assert.deepEqual([result.width, result.height], [640, 512]);
    assert.equal(result.blue, 0, "nothing is drawn into the picture itself");
    assert.equal(await front.locator("svg .mark").count(), 2, "the code's outline and the way to it");
    for (const [step, right] of [
      ["edges", (p) => p.grey === 0 && p.bright > 0.005 && p.bright < 0.2 && p.dark > 0.8],
      ["corners", (p) => p.blue > 0.001],
      ["grey", (p) => p.grey > 0.3 && p.blue === 0],
    ]) {
      const before = await img.getAttribute("src");
      await front.getByRole("button", { name: words[step], exact: true }).click();
      await until(`the picture of ${step}`, async () => (await img.getAttribute("src")) !== before && right(await pixelsOf(img)), { timeout_s: 10, every_ms: 100 });
      await picture(page, `desk-${step}-${width}-${lang}-${theme}`);
      assert.equal(await front.locator("svg .mark").count(), 0, "our own result is not drawn over it");
    }
    await front.getByRole("button", { name: words.result, exact: true }).click();
    await looksRight(page, `cameras-${width}-${lang}-${theme}`);

    await view(page, words.lifts);
    await page.locator(".bodyview .lifts .feet .cmd").first().waitFor();
    await looksRight(page, `lifts-${width}-${lang}-${theme}`);
    if (width === 1920) assert.deepEqual(await faultsOf(page), []);
    await page.reload();
    await page.locator(".bodyview .lifts").waitFor(); // and stays so
    await view(page, words.way);
    await page.locator(".c3 canvas").waitFor();
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}

test("sent from there, its wheels are seen to steer and roll, and a fault of one is said on it", async () => {
  const page = await open({ width: 1920, height: 1080 });
  await view(page, kEn.platform);
  const start = page.getByRole("button", { name: /Start move/ });
  await until("start can be armed", async () => (await start.count()) > 0 && (await start.getAttribute("aria-disabled")) !== "true", { timeout_s: 30, every_ms: 100 });
  await page.getByRole("button", { name: /Arm/ }).click();
  await page.getByText(/[1-7] s left/).waitFor();
  await start.click();
  await page.locator(".sgrid.moving").waitFor();
  await page.locator(".bodyview .wl", { hasText: /[1-9]\d?\.\d°/ }).first().waitFor();
  await page.locator(".bodyview .wl", { hasText: /([1-9]\.\d\d|0\.[1-9]\d)\s*m\/s/ }).first().waitFor();
  await picture(page, "desk-moving-1920-en-light");
  const [order] = (await client.get(`/api/v1/job-orders?vehicle=${kId}`)).items;
  assert.equal((await client.untilEnded(order.id, 120)).state, "Ended");
  await system.kill(system.agents.get(kId));
  system.startAgent(kId, { seed: 22, timeFactor: 6, extra: ["--fault", "wheel=FR@1"] });
  await client.untilVehicle(kId, (v) => v.wheels.some((wheel) => wheel.fault !== ""), "has a wheel fault", 120);
  await page.locator(".bodyview .wl.bad2").first().waitFor();
  await picture(page, "desk-fault-1920-en-light");
  assert.deepEqual(page.errors, []);
  await page.context().close();
});
