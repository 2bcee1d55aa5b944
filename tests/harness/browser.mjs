// Chromium driven by Playwright against the real server. Screens are found by role and name, as people find them.
import { createRequire } from "node:module";
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { BUILD, ROOT, until } from "./processes.mjs";

const require = createRequire(join(ROOT, "web/package.json"));
export const { chromium } = require("playwright-core");
export const axeSource = () => require.resolve("axe-core/axe.min.js");

export async function startBrowser() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage"],
  });
}

/** A page signed in as `role`; console errors fail the test that asks for them. */
export async function signedIn(browser, system, role, { width = 1920, height = 1080, lang = "en", theme = "light", path = "/map", bypassCSP = false, init, magnification = 1 } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, locale: lang === "zh" ? "zh-CN" : "en-GB", reducedMotion: "reduce", bypassCSP, deviceScaleFactor: magnification });
  const page = await context.newPage();
  if (init) await page.addInitScript(init);
  page.errors = [];
  page.on("pageerror", (error) => page.errors.push(String(error)));
  await page.goto(`${system.url}${path}?lang=${lang}&theme=${theme}`);
  await page.locator("input[name=username]").fill(role);
  await page.locator("input[type=password]").fill(system.passwords.get(role));
  await page.locator("button[type=submit]").click();
  await page.locator(".shell").waitFor({ timeout: 15_000 });
  return page;
}

/** Keeps a picture in build/screenshots for people to look at. */
export async function picture(page, name) {
  const folder = join(BUILD, "screenshots");
  mkdirSync(folder, { recursive: true });
  await page.screenshot({ path: join(folder, `${name}.png`) });
}

/** Accessibility faults of what the page shows now. */
export async function faultsOf(page) {
  if (await page.evaluate(() => globalThis.axe === undefined)) await page.evaluate(readFileSync(axeSource(), "utf8"));
  const violations = await page.evaluate(async () => {
    const ask = async (where, what) => (await globalThis.axe.run(where, { ...what, resultTypes: ["violations"] })).violations;
    const { axe } = globalThis;
    const rules = { "page-has-heading-one": { enabled: true } };
    const found = await ask(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21aa", "wcag22aa"], rules });
    const faults = [];
    for (const { id, nodes } of found) {
      for (const { target } of nodes) {
        // A row at the edge of a list is cut there and looks small; what a finger would scroll into sight is asked again there.
        if (id === "target-size" && target.length === 1) {
          document.querySelector(target[0])?.scrollIntoView({ block: "center", inline: "nearest", behavior: "instant" });
          if ((await ask({ include: target }, { runOnly: { type: "rule", values: [id] } })).length === 0) continue;
        }
        faults.push([id, target.join(" ")]);
      }
    }
    if (found.some(({ id }) => id === "target-size")) for (const e of document.querySelectorAll("*")) if (e.scrollTop > 0) e.scrollTop = 0;
    axe.reset?.();
    return faults;
  });
  const byRule = Map.groupBy?.(violations, ([id]) => id) ?? violations.reduce((all, one) => all.set(one[0], [...(all.get(one[0]) ?? []), one]), new Map());
  return [...byRule].map(([id, nodes]) => `${id}: ${nodes.map(([, target]) => target).slice(0, 3).join("; ")}`);
}

/** A command of two steps, by a person who waits between them: the guard is up for three seconds after a stop. */
export async function decide(page, button) {
  const armed = page.locator(".cmd[data-state=armed]");
  await button.scrollIntoViewIfNeeded();
  await until("it can be armed", async () => {
    await button.click();
    return armed.waitFor({ timeout: 700 }).then(() => true, () => false);
  }, { timeout_s: 10, every_ms: 500 });
  await page.waitForTimeout(450); // a second press that comes sooner is the same tap
  await armed.click();
}
