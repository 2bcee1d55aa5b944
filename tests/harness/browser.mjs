// Chromium driven by Playwright against the real server. Screens are found by role and name, as people find them.
import { createRequire } from "node:module";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { BUILD, ROOT } from "./processes.mjs";

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
export async function signedIn(browser, system, role, { width = 1920, height = 1080, lang = "en", theme = "light", path = "/map", bypassCSP = false } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, locale: lang === "zh" ? "zh-CN" : "en-GB", reducedMotion: "reduce", bypassCSP });
  const page = await context.newPage();
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

/** Serious accessibility faults of what the page shows now, but for the rules of `without`. */
export async function faultsOf(page, { without = [] } = {}) {
  await page.addScriptTag({ path: axeSource() });
  const rules = Object.fromEntries(without.map((rule) => [rule, { enabled: false }]));
  const result = await page.evaluate((off) => globalThis.axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21aa", "wcag22aa"], rules: off }), rules);
  return result.violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target.join(" ")).slice(0, 3).join("; ")}`);
}
