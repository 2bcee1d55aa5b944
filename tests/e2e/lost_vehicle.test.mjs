// A vehicle that was carried off on its way: it says so, a person says on its page where it stands, and lets its order go on.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";

const ID = "DL-01", MAPS = "db/maps/landmark-lab", DEG = Math.PI / 180;
let system, client, browser, order;

before(async () => {
  system = await System.create("landmark-lab");
  system.prepareVehicles([ID]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  system.startAgent(ID, { seed: 71, timeFactor: 4, sensing: "analytic", extra: ["--drive", "servo", "--maps", MAPS, "--fault", "driving:carried=1,-1.5,-60@1"] }); // near a corner: half way its walls look alike all along
  await client.untilReady(ID);
  browser = await startBrowser();
  for (let i = 0; (await client.get(`/api/v1/vehicles/${ID}`)).pose_known; ++i) {
    order = await client.order(ID, [i % 2 === 0 ? 3 : 1]);
    const { state } = await client.untilOrder(order.id, (o) => ["Ended", "Interrupted"].includes(o.state), "ended or is interrupted", 60);
    if (state === "Interrupted") break;
    assert.ok(i < 10, "nobody carried it off");
  }
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

/** Nothing lies over its middle, nor is that cut off by what it stands in. */
const canBePressed = (locator) => locator.evaluate((button) => {
  const { left, top, width, height } = button.getBoundingClientRect();
  return button.contains(document.elementFromPoint(left + width / 2, top + height / 2)) && button.contains(document.elementFromPoint(left + width / 2, top + height - 6));
});

for (const [lang, theme] of [["en", "light"], ["zh", "dark"]]) {
  test(`its page says what it lacks and what to do, and the position can be set at 1920 and 1024 px, ${lang}`, async () => {
    const page = await signedIn(browser, system, "operator", { path: `/vehicles/${ID}`, lang, theme });
    for (const width of [1920, 1024]) {
      await page.setViewportSize({ width, height: 1080 });
      if (width < 1536) await page.getByRole("tab").nth(2).click();
      await page.locator(".whycard", { hasText: lang === "en" ? "It does not know where it stands" : "不知道自身位置" }).waitFor();
      assert.ok(await canBePressed(page.locator(".init button.cmd")), `at ${width} px`);
      await picture(page, `lost-${lang}-${width}`);
    }
    assert.deepEqual(await faultsOf(page), []);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  });
}

test("told where it stands, 0.1 m and 5 deg off, and let go on, it finds itself and ends its order", async () => {
  const page = await signedIn(browser, system, "operator", { path: `/vehicles/${ID}` });
  const stands = system.lastTruth(ID);
  await page.getByRole("button", { name: "By numbers" }).click();
  await page.getByLabel("East x, mm").fill(String(Math.round(1e3 * (stands.x_m + 0.07))));
  await page.getByLabel("North y, mm").fill(String(Math.round(1e3 * (stands.y_m - 0.07))));
  await page.getByLabel("Heading, °").fill((stands.heading_rad / DEG + 5).toFixed(1));
  await picture(page, "lost-numbers");
  await twice("Set position");
  await client.untilVehicle(ID, (v) => v.pose_known, "has heard it");
  assert.equal((await client.get(`/api/v1/job-orders/${order.id}`)).state, "Interrupted", "a position moves nothing");
  await twice("Resume");
  const ended = await client.untilEnded(order.id, 60);
  assert.equal(ended.state, "Ended", JSON.stringify(ended.reason));
  assert.ok((await client.stops(order.id)).at(-1).inside);
  // What told it its place since, and what became of it.
  const { fixes } = await client.get(`/api/v1/vehicles/${ID}`);
  assert.ok(fixes.some(({ by, result, times }) => by === "stop" && result === "taken" && times === 1), JSON.stringify(fixes));
  assert.equal(await page.locator(".fixes tbody tr").count(), 3, "the newest");
  await picture(page, "lost-fixes-few");
  await page.locator(".fixes button", { hasText: "All" }).click();
  assert.equal(await page.locator(".fixes tbody tr").count(), fixes.length);
  assert.match(await page.locator(".fixes tbody tr", { hasText: "Stop measured" }).first().innerText(), /taken/);
  await picture(page, "lost-fixes");
  await until("its page has nothing to say any more", async () => (await page.locator(".init").count()) === 0);
  assert.deepEqual(page.errors, []);
  await page.context().close();

  async function twice(name) {
    await page.locator("button.cmd", { hasText: name }).first().click();
    await page.locator("[data-state=armed]").getByText(/[1-7] s/).waitFor();
    await page.locator("[data-state=armed]").click();
  }
});
