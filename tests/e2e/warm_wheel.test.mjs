// A wheel whose bearing grinds, as its pages tell it. A simulated one takes minutes of driving to grow warm, and so a vehicle
// without a model speaks here: plain VDA 5050 with its wheels' temperatures.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";
import { picture, signedIn, startBrowser } from "../harness/browser.mjs";

let system, client, browser, vehicle;

/** DL-01, which stands at home and reports five times a second; `left_c` is the temperature of its left wheel. */
class PlainVehicle {
  left_c = 31;
  sent = 0;

  async connect() {
    const { id, manufacturer, serial_number: serialNumber, home } = system.plant.vehicle("DL-01");
    this.who = { version: "2.1.0", manufacturer, serialNumber };
    this.station = system.plant.model.stations.find((s) => s.id === home);
    this.socket = new WebSocket(`ws://${system.host}:${system.port}/vehicles/${manufacturer}/${serialNumber}`, { protocols: ["vda5050.v2.json"], headers: { Authorization: `Bearer ${system.tokenOf(id)}` } });
    await new Promise((done, failed) => { this.socket.onopen = done; this.socket.onerror = () => failed(new Error("no link")); });
    this.send("connection", { connectionState: "ONLINE" });
    this.timer = setInterval(() => this.report(), 200);
    this.report();
  }
  report() {
    const { node, pose, hall } = this.station;
    const wheel = (name, temperature_c) => ({
      infoType: "wheel", infoLevel: "INFO",
      infoReferences: Object.entries({ name, steering_rad: 0, speed_mps: 0, temperature_c }).map(([referenceKey, value]) => ({ referenceKey, referenceValue: String(value) })),
    });
    this.send("state", {
      orderId: "", orderUpdateId: 0, lastNodeId: node, lastNodeSequenceId: 0, driving: false, operatingMode: "AUTOMATIC", nodeStates: [], edgeStates: [], actionStates: [], errors: [],
      batteryState: { batteryCharge: 80, charging: false }, safetyState: { eStop: "NONE", fieldViolation: false },
      agvPosition: { x: pose.x_m, y: pose.y_m, theta: pose.heading_rad, mapId: hall, positionInitialized: true },
      information: [wheel("left", this.left_c), wheel("right", 31)],
    });
  }
  send(topic, message) {
    this.socket.send(JSON.stringify({ topic, retain: topic === "connection", payload: { headerId: this.sent++, timestamp: new Date().toISOString(), ...this.who, ...message } }));
  }
  close() {
    clearInterval(this.timer);
    this.socket?.close();
  }
}

before(async () => {
  system = await System.create("final-assembly");
  system.prepareVehicles(["DL-01"]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  browser = await startBrowser();
  vehicle = new PlainVehicle();
  await vehicle.connect();
  await client.untilReady("DL-01");
});
after(async () => {
  vehicle?.close();
  await browser?.close();
  await system?.stop();
});

test("a wheel whose bearing grinds: cool at first, then warm on faceplate, in list, counter and checks, with what to do", async () => {
  const looks = [[1920, 1080, "en"], [1024, 768, "zh"], [390, 844, "en"]];
  const pages = await Promise.all(looks.map(([width, height, lang]) => signedIn(browser, system, "operator", { width, height, lang })));
  const counted = (page) => page.locator(".al").nth(2).innerText().then(Number);
  const words = {
    en: { wheel: "Wheel left is warm, 71 °C", todo: "It may drive on; watch it.", label: /71/, check: /Wheel left warm: 71/, notes: /\d to note/ },
    zh: { wheel: /左轮.*71/, todo: /可继续行驶/, label: /71/, check: /左轮偏热：71/, notes: /\d 项须留意/ },
  };
  const cool = [];
  for (const page of pages) {
    await page.goto(`${system.url}/vehicles/DL-01`);
    await page.locator(".wl").first().waitFor();
    assert.equal(await page.locator(".wl.adv2").count(), 0, "no wheel is warm");
    cool.push(await counted(page));
  }

  vehicle.left_c = 71;

  for (const [i, page] of pages.entries()) {
    const [width, , lang] = looks[i];
    const { wheel, todo, label, check, notes } = words[lang];
    await page.locator(".wl.adv2", { hasText: label }).waitFor();
    assert.equal(await page.locator(".wl.adv2").count(), 1, "the other wheel is cool");
    await until("it is counted", async () => (await counted(page)) === cool[i] + 1, { timeout_s: 10, every_ms: 50 });
    await picture(page, `warm-wheel-${width}-${lang}`);
    if (width < 1536) await page.getByRole("tab", { name: lang === "en" ? "Why and pose" : /原因/ }).click();
    await page.locator(".why", { hasText: wheel }).waitFor();
    await page.locator(".why .todo", { hasText: todo }).waitFor();
    await page.goto(`${system.url}/map`);
    await page.locator('.g-attention [data-vehicle="DL-01"] .what', { hasText: wheel }).waitFor();
    await page.goto(`${system.url}/send?vehicle=DL-01&station=35`);
    await page.locator(".checks .chk[data-result=note]", { hasText: check }).waitFor({ timeout: 20_000 });
    await page.locator(".s4 .ans.r", { hasText: notes }).waitFor();
    await picture(page, `warm-wheel-send-${width}-${lang}`);
    assert.deepEqual(page.errors, []);
  }

  vehicle.left_c = 31;
  const [page] = pages;
  await page.goto(`${system.url}/vehicles/DL-01`);
  await page.locator(".wl").first().waitFor();
  await page.locator(".wl.adv2").waitFor({ state: "detached" });
  await until("it is counted no more", async () => (await counted(page)) === cool[0], { timeout_s: 10, every_ms: 50 });
});
