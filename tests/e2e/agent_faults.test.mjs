// Each fault that an agent can inject, but a bearing that grinds (see warm_wheel.test.mjs), as its pages tell it: headline,
// counter, list and what to do, in both languages and at three sizes. A broken wheel and dark cameras are in truth.test.mjs; what
// frees the way again is in closed_loop/safe_stops.test.mjs.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";
import { picture, signedIn, startBrowser } from "../harness/browser.mjs";

const VEHICLES = ["TP-01", "TP-02", "MV-01", "DL-01", "OM-01"];
let system, client, browser;

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles(VEHICLES);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

const start = async (id, faults, options = {}) => {
  system.startAgent(id, { seed: 5, ...options, extra: [...(options.extra ?? []), ...faults.flatMap((fault) => ["--fault", fault])] });
  await client.untilReady(id);
};

/** One page a size and language for all faults: a person signs in once, and the server bounds how often one may. */
const pages = new Map();
async function pageOf(width, height, lang) {
  const key = `${width}-${lang}`;
  if (!pages.has(key)) pages.set(key, await signedIn(browser, system, "operator", { width, height, lang }));
  return pages.get(key);
}

/** The vehicle's page and the map's list at each size and in each language. `tell[lang]`: headline, what to do. */
async function shown(id, priority, tell) {
  for (const [width, height, lang] of [[1920, 1080, "en"], [1024, 768, "zh"], [390, 844, "en"], [1920, 1080, "zh"]]) {
    const [headline, todo] = tell[lang];
    const page = await pageOf(width, height, lang);
    await page.goto(`${system.url}/vehicles/${id}`);
    if (width < 1536) {
      await page.locator(".whyl b", { hasText: headline }).waitFor();
      await page.getByRole("tab", { name: lang === "en" ? "Why and pose" : /原因/ }).click();
    } else await page.locator(".why .ans1", { hasText: headline }).waitFor();
    await page.locator(".why .todo", { hasText: todo }).waitFor();
    await picture(page, `fault-${id}-${width}-${lang}`);
    await page.goto(`${system.url}/map`);
    await page.locator(`.g-attention [data-vehicle="${id}"] .what`, { hasText: headline }).waitFor();
    const counter = page.locator(`.al.has-${priority}`);
    assert.ok(Number(await counter.innerText()) >= 1, "it is counted");
    assert.deepEqual(page.errors, []);
  }
}

test("obstacle: something in the way stops it and is told", async () => {
  await start("DL-01", ["obstacle=97,46@0"]);
  await client.order("DL-01", [35]);
  await client.untilVehicle("DL-01", (v) => v.field_violation && v.activity === "blocked", "is blocked");
  await shown("DL-01", 2, {
    en: [/Stopped: something stands in its protective field/, /Clear the area around it/],
    zh: [/已停车：防护区内有物体/, /请清空车辆周围区域/],
  });
  await system.kill(system.agents.get("DL-01"));
});

test("slip: a wheel that slips is a fault that needs a person", async () => {
  await start("TP-01", ["slip=front drive:0.2@0.5"]);
  await client.order("TP-01", [2]);
  await client.untilVehicle("TP-01", (v) => v.errors.some((e) => e.type === "wheelSlip"), "slips");
  await shown("TP-01", 1, {
    en: [/Fault: a wheel slips/, /Look at the vehicle and clear the fault there/],
    zh: [/故障：车轮打滑/, /请到车旁查看并排除故障/],
  });
});

test("encoder: a wheel that measures nothing any more is a fault of that wheel", async () => {
  await start("TP-02", ["encoder=front drive@0.5"]);
  await client.order("TP-02", [6]);
  await client.untilVehicle("TP-02", (v) => v.wheels.some((w) => w.fault !== ""), "has a wheel at fault");
  await shown("TP-02", 2, {
    en: [/Wheel front drive: drive fault/, /Have the wheel looked at before it moves on/],
    zh: [/前驱动轮：/, /继续行驶前请检修该车轮/],
  });
});

test("marker-lost: a stop without a code is not measured", async () => {
  await start("MV-01", ["marker-lost@1"]);
  const order = await client.order("MV-01", [13]);
  await client.untilOrder(order.id, (o) => o.state === "Interrupted", "is interrupted");
  await shown("MV-01", 2, {
    en: [/The stop at station 13 could not be measured/, /Look at the codes under its cameras/],
    zh: [/13 号站的停站未能测量/, /请查看并清洁相机下方的地面码/],
  });
});
