// Pictures of send, vehicle, orders, records and stations with made-up data:
// node dev/page-shots.mjs DIST_DIR OUT_DIR [only] (after `npm run build`).
import { mkdirSync, readFileSync } from "node:fs";
import { extname, join } from "node:path";
import AxeBuilder from "@axe-core/playwright";
import { chromium } from "playwright-core";
import { plant, session, snapshot } from "./fixtures.mjs";
import { dryRun, enrich, kOrder, orderFor, stopFor } from "./page-fixtures.mjs";

const [dist, out, only] = process.argv.slice(2);
mkdirSync(out, { recursive: true });
const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml" };
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"],
});
const picture = readFileSync(new URL("../public/favicon.svg", import.meta.url));

async function open({ path, size = [1920, 1080], lang = "en", theme = "light", change, answer }) {
  const context = await browser.newContext({ viewport: { width: size[0], height: size[1] } });
  const page = await context.newPage();
  page.on("pageerror", (error) => console.log("page error:", error.message));
  page.on("console", (m) => m.type() === "error" && console.log("console:", m.text()));
  const model = plant();
  const first = enrich(snapshot(model), model);
  change?.(first, model);
  const sent = [];
  let socket;
  await page.route("http://pulse.test/**", (route) => {
    const request = route.request();
    const url = new URL(request.url());
    const json = (body, status = 200) => route.fulfill({ status, json: body });
    if (url.pathname.startsWith("/api/")) {
      if (url.pathname.endsWith("/session")) return json(session);
      if (url.pathname.endsWith("/plant")) return json(model);
      if (url.pathname.includes("/cameras/"))
        return route.fulfill({ body: picture, contentType: "image/svg+xml" });
      if (url.pathname.endsWith("/loads")) return json({ items: (model.loads ?? []).map(asKnown) });
      if (url.pathname.endsWith("/stop-records")) return json({ items: first.stop_records });
      if (url.pathname.endsWith("/job-orders") && request.method() === "GET")
        return json({ items: first.job_orders });
      if (url.pathname.endsWith("/job-orders")) {
        const body = request.postDataJSON();
        sent.push({ dry: url.searchParams.has("dryRun"), body, key: request.headers()["idempotency-key"] });
        if (url.searchParams.has("dryRun")) return json(dryRun(model, first, body));
        return answer ? answer(route, first, model) : json(orderFor(first), 201);
      }
      return json({ code: "not_found", detail: "not in the fixture", request_id: "7f3a0000" }, 404);
    }
    const file = extname(url.pathname) === "" ? "index.html" : url.pathname.slice(1);
    return route.fulfill({
      body: readFileSync(join(dist, file)),
      contentType: types[extname(file)] ?? "text/plain",
    });
  });
  await page.routeWebSocket("ws://pulse.test/api/v1/stream", (ws) => {
    socket = ws;
    ws.send(JSON.stringify(first));
    const timer = setInterval(() => {
      ws.send(JSON.stringify({ type: "poses", at: new Date().toISOString(), poses: [] }));
    }, 200);
    timer.unref(); // a page that is closed does not close its stream here
    ws.onClose(() => clearInterval(timer));
  });
  const mark = path.includes("?") ? "&" : "?";
  await page.goto(`http://pulse.test${path}${mark}lang=${lang}&theme=${theme}`);
  await page.waitForTimeout(1300);
  return { page, first, model, sent, send: (frame) => socket.send(JSON.stringify(frame)) };
}

/** A load of the plant's file as the server tells it. */
function asKnown(load) {
  const place = { vehicle: undefined, station: undefined }; // comes with the stream
  return { centre: { x_m: 0, y_m: 0 }, carriers: [], ...load, ...place, since: new Date().toISOString() };
}

async function sent67(ctx) {
  await ctx.page.getByRole("button", { name: /Arm|准备/ }).click();
  await ctx.page.waitForTimeout(600);
  await ctx.page.locator(".go").dblclick();
  await ctx.page.waitForTimeout(500);
  const real = ctx.sent.filter((s) => !s.dry);
  console.log("posts after a double tap:", real.length, "key", real[0]?.key?.length);
}
const vehicle = (first, id) => first.vehicles.find((v) => v.id === id);
const send = "/send?vehicle=TP-01&station=7";
const small = [1024, 768];
const phone = [390, 844];
/** The fleet paused 4 s ago, OM-03 by itself before that; `moving` still brake. */
const pausedFleet = (moving) => (first) => {
  const by = (name, agoS, with_fleet, stands) => ({
    paused: true,
    activity: stands ? "paused" : "moving",
    pause: { by: name, at: new Date(Date.now() - agoS * 1000).toISOString(), with_fleet, stands },
  });
  for (const v of first.vehicles)
    Object.assign(v, by("panel-2", 4, true, !moving.includes(v.id)), { reason: undefined });
  Object.assign(vehicle(first, "OM-03"), by("m.weber", 900, false, true));
  first.fleet.paused = true;
  first.fleet.pause = { by: "panel-2", at: new Date(Date.now() - 4000).toISOString() };
};
const pausedAlone = (stands) => (first) => {
  const at = new Date(Date.now() - 4000).toISOString();
  Object.assign(vehicle(first, "TP-01"), {
    paused: true,
    activity: stands ? "paused" : "moving",
    pause: { by: "panel-2", at, with_fleet: false, stands },
  });
};
/** One alarm of each kind that has no picture elsewhere. */
const alarmed = (first) => {
  const tp = vehicle(first, "TP-01");
  tp.brackets[0].force_a_n *= 1.4;
  tp.brackets[0].force_b_n *= 1.4;
  tp.worst_bracket = { bracket: "front left", share: 0.17, limit: 0.1 };
  tp.load_fault = { code: "load_unbalanced", params: {} };
  tp.wheels[4].fault = "servo_overload";
  tp.e_stop = "MANUAL";
  tp.pose_basis = {
    kind: "stop",
    station: "st05",
    at: new Date(Date.now() - 400000).toISOString(),
    driven_m: 12.3,
  };
  tp.pose_deviation_m = 0.031;
  vehicle(first, "DL-02").reason = { code: "stop_not_measured", params: { station: 38, why: "" } };
  vehicle(first, "OM-03").pose_known = false;
};
const shots = {
  "send-light": { path: send },
  "send-dark": { path: send, theme: "dark" },
  "send-zh": { path: send, lang: "zh" },
  "send-1024": { path: send, size: small },
  "send-1024-2": { path: "/send?vehicle=TP-01", size: small },
  "send-1024-3": {
    path: send,
    size: small,
    act: (c) => c.page.getByRole("button", { name: /Change: Motion/ }).click(),
  },
  "send-empty": { path: "/send" },
  "send-wrong": { path: "/send?vehicle=TP-01&station=99" },
  "send-armed": { path: send, act: (c) => c.page.getByRole("button", { name: /Arm/ }).click() },
  "send-pick": { path: "/send?vehicle=TP-01", act: (c) => c.page.getByText("Pick on map").click() },
  "send-stored": { path: send, act: sent67 },
  "send-moving": {
    path: send,
    async act(c) {
      await sent67(c);
      const order = { ...orderFor(c.first), state: "Running", revision: 2 };
      order.steps[0].state = "driving";
      c.send({ type: "job_order", job_order: order });
      const tp = vehicle(c.first, "TP-01");
      c.send({
        type: "vehicle",
        vehicle: {
          ...tp,
          activity: "moving",
          speed_mps: 0.31,
          order: kOrder,
          at_station: "",
          leg: {
            id: kOrder,
            station: "st07",
            mode: "linear",
            path: [
              { x_m: 85, y_m: 20 },
              { x_m: 95, y_m: 20 },
            ],
            granted_points: 2,
            granted_area: [],
            duration_s: 91,
            progress: 0.42,
            expected_at: new Date(Date.now() + 52000).toISOString(),
          },
        },
      });
      await c.page.waitForTimeout(500);
    },
  },
  "send-arrived": {
    path: send,
    async act(c) {
      await sent67(c);
      const stop = stopFor(c.model, "TP-01", 7, -0.00598, 0.00435, -0.125, 0);
      const order = { ...orderFor(c.first), state: "Ended", revision: 3, current_step: 0 };
      order.steps[0] = { ...order.steps[0], state: "done", stop: stop.id };
      c.send({ type: "stop_record", stop_record: { ...stop, order: kOrder } });
      c.send({ type: "job_order", job_order: order });
      await c.page.waitForTimeout(500);
    },
  },
  "send-refused": {
    path: send,
    act: sent67,
    answer: (route) =>
      route.fulfill({
        status: 409,
        json: {
          type: "urn:pulseline:problem:vehicle_gone",
          title: "Gone",
          status: 409,
          code: "vehicle_gone",
          detail: "TP-01 is gone.",
          params: { vehicle: "TP-01", silent_s: 84 },
          request_id: "7f3a0000",
        },
      }),
  },
  "vehicle-light": { path: "/vehicles/TP-01" },
  "vehicle-dark": { path: "/vehicles/TP-01", theme: "dark" },
  "vehicle-zh": { path: "/vehicles/TP-01", lang: "zh" },
  "vehicle-1024": { path: "/vehicles/TP-01", size: small },
  "vehicle-init": {
    path: "/vehicles/TP-01",
    change: (f) =>
      Object.assign(vehicle(f, "TP-01"), {
        pose_known: false,
        activity: "unknown",
        reason: { code: "pose_unknown", params: {} },
      }),
  },
  "vehicle-late": { path: "/vehicles/MV-02" },
  "vehicle-list": { path: "/vehicles" },
  "alarms-vehicle": { path: "/vehicles/TP-01", change: alarmed },
  "alarms-vehicle-zh-dark": { path: "/vehicles/TP-01", change: alarmed, lang: "zh", theme: "dark" },
  "alarms-vehicle-1024": { path: "/vehicles/TP-01", change: alarmed, size: small },
  "alarms-map": { path: "/map", change: alarmed },
  "alarms-map-zh-1024": { path: "/map", change: alarmed, lang: "zh", size: small },
  "alarms-list": { path: "/vehicles", change: alarmed },
  "pause-vehicle-stopping": { path: "/vehicles/TP-01", change: pausedAlone(false) },
  "pause-vehicle-zh-dark": {
    path: "/vehicles/TP-01",
    change: pausedAlone(true),
    lang: "zh",
    theme: "dark",
  },
  "pause-vehicle-1024": { path: "/vehicles/TP-01", change: pausedAlone(true), size: small },
  "pause-vehicle-390": { path: "/vehicles/TP-01", change: pausedAlone(true), size: phone },
  "pause-fleet-map": { path: "/map", change: pausedFleet(["TP-02", "OM-01", "MV-02"]) },
  "pause-fleet-1024": { path: "/orders", change: pausedFleet([]), size: small },
  "pause-fleet-zh-dark-1024": {
    path: "/map",
    change: pausedFleet(["TP-02"]),
    size: small,
    lang: "zh",
    theme: "dark",
  },
  "pause-fleet-resume": {
    path: "/map",
    change: pausedFleet([]),
    act: (c) => c.page.getByRole("button", { name: "Resume…" }).click(),
  },
  "send-busy": {
    path: "/send?vehicle=TP-02&station=7",
    change: (f) =>
      Object.assign(f.job_orders[0], { expected_at: new Date(Date.now() + 84000).toISOString() }),
  },
  "send-wrong-type": { path: "/send?vehicle=TP-01&station=15" },
  "record-light": { path: "/records/REC" },
  "record-dark": { path: "/records/REC", theme: "dark" },
  "record-zh": { path: "/records/REC", lang: "zh" },
  "record-1024": { path: "/records/REC", size: small },
  "record-list": { path: "/records" },
  "orders-light": { path: "/orders" },
  "orders-detail": { path: "/orders/ORD" },
  "orders-zh-dark": { path: "/orders/ORD", lang: "zh", theme: "dark" },
  "orders-1024": { path: "/orders", size: small },
  "orders-new": {
    path: "/orders",
    async act(c) {
      await c.page.getByRole("button", { name: "New order" }).click();
      for (const n of ["1", "2"]) {
        await c.page
          .getByLabel(/^Station \d+$/)
          .last()
          .fill(n);
        await c.page.getByRole("button", { name: "Add station" }).click();
      }
    },
  },
  "stations-light": { path: "/stations" },
  "stations-zh-dark": { path: "/stations", lang: "zh", theme: "dark" },
  "stations-1024": { path: "/stations", size: small },
};

for (const [name, shot] of Object.entries(shots)) {
  if (only !== undefined && !new RegExp(only).test(name)) continue;
  const probe = enrich(snapshot(plant()), plant());
  const path = shot.path.replace("REC", probe.stop_records[0].id).replace("ORD", probe.job_orders[0].id);
  const ctx = await open({ ...shot, path });
  try {
    await shot.act?.(ctx);
    await ctx.page.waitForTimeout(200);
  } catch (error) {
    console.log(name, "act failed:", error.message.split("\n")[0]);
  }
  await ctx.page.screenshot({ path: join(out, `${name}.png`) });
  const axe = await new AxeBuilder({ page: ctx.page })
    .include("main")
    .analyze()
    .catch((e) => ({ violations: [], e }));
  if (axe.e) console.log(name, "axe:", axe.e.message.split("\n")[0]);
  for (const v of axe.violations)
    console.log(name, "axe:", v.id, v.nodes.length, v.nodes[0].html.slice(0, 150));
  const little = await ctx.page.evaluate(() =>
    [...document.querySelectorAll("main button, main a, main select, main input")]
      .map((e) => ({
        r: e.getBoundingClientRect(),
        t: e.className + " " + (e.textContent ?? "").slice(0, 20),
      }))
      .filter(({ r }) => r.width > 0 && (r.height < 47.5 || r.width < 47.5))
      .map(({ r, t }) => `${t} ${Math.round(r.width)}x${Math.round(r.height)}`),
  );
  if (little.length > 0) console.log(name, "small targets:", little.length, little.slice(0, 3));
  await ctx.page.context().close();
}
await browser.close();
