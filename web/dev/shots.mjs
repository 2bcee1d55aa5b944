// Pictures of the built dashboard with made-up data: node dev/shots.mjs OUT_DIR [path] (after `npm run build`).
import { mkdirSync, readFileSync } from "node:fs";
import { extname, join } from "node:path";
import { chromium } from "playwright-core";
import { plant, poses, session, snapshot } from "./fixtures.mjs";

const out = process.argv[2] ?? "test-results/shots";
const path = process.argv[3] ?? "/map?vehicle=TP-02";
const dist = new URL("../dist/", import.meta.url).pathname;
mkdirSync(out, { recursive: true });
const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml" };

const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"],
});

async function open(width, height, lang, theme, options = {}) {
  const page = await browser.newPage({ viewport: { width, height } });
  page.on("pageerror", (error) => console.log("page error:", error.message));
  page.on("console", (m) => m.type() === "error" && console.log("console:", m.text()));
  const model = plant();
  const first = snapshot(model);
  await page.route("http://pulse.test/**", (route) => {
    const url = new URL(route.request().url());
    if (url.pathname.startsWith("/api/")) {
      if (url.pathname.endsWith("/session")) {
        return options.signedOut
          ? route.fulfill({
              status: 401,
              json: { code: "not_signed_in", detail: "" },
              contentType: "application/problem+json",
            })
          : route.fulfill({ json: session });
      }
      if (url.pathname.endsWith("/plant")) return route.fulfill({ json: model });
      if (url.pathname.endsWith("/fleet/pause"))
        return route.fulfill({ status: 202, json: { ...first.fleet, paused: true } });
      return route.fulfill({ status: 404, json: { code: "unknown", detail: "not in the mock" } });
    }
    const file = extname(url.pathname) === "" ? "index.html" : url.pathname.slice(1);
    return route.fulfill({
      body: readFileSync(join(dist, file)),
      contentType: types[extname(file)] ?? "text/plain",
    });
  });
  let connected = 0;
  await page.routeWebSocket("ws://pulse.test/api/v1/stream", (socket) => {
    if (options.cut && connected++ > 0) return void socket.close();
    socket.send(JSON.stringify(first));
    let tick = 0;
    const timer = setInterval(() => {
      if (options.cut && tick > 8) return;
      socket.send(JSON.stringify(poses(first.vehicles, tick++)));
    }, 100);
    timer.unref(); // a page that is closed does not close its stream here
    socket.onClose(() => clearInterval(timer));
  });
  const separator = path.includes("?") ? "&" : "?";
  await page.goto(`http://pulse.test${options.path ?? path}${separator}lang=${lang}&theme=${theme}`);
  await page.waitForTimeout(options.wait ?? 1200);
  return page;
}

const shots = [
  ["1920-light-en", 1920, 1080, "en", "light"],
  ["1920-dark-zh", 1920, 1080, "zh", "dark"],
  ["1024-light-en", 1024, 768, "en", "light"],
  ["signin", 1024, 768, "en", "light", { signedOut: true }],
  ["lost", 1920, 1080, "en", "light", { cut: true, wait: 6500 }],
];
const only = process.argv[4];
for (const [name, width, height, lang, theme, options] of shots) {
  if (only !== undefined && !name.includes(only)) continue;
  const page = await open(width, height, lang, theme, options);
  await page.screenshot({ path: join(out, `${name}.png`) });
  await page.close();
}
await browser.close();
