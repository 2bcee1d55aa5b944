// Two people at one vehicle, each signed in on a page of their own: both see who has it, nothing is sent twice or lost, and
// what one of them takes from the other is named before and after. And what a page says when its session has ended.
import assert from "node:assert/strict";
import { after, afterEach, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System, until } from "../harness/processes.mjs";
import { faultsOf, picture, signedIn, startBrowser } from "../harness/browser.mjs";
import { reachFaultsOf } from "../harness/reach.mjs";

let system, client, browser;

const addUser = (name, password) => {
  system.cli(["user", "add", name, "--role", "operator", "--password-stdin"], password);
  system.passwords.set(name, password);
};

before(async () => {
  system = await System.create("final-assembly");
  addUser("anna", "test-password-of-anna");
  system.prepareVehicles(["TP-01"]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  system.startAgent("TP-01", { seed: 51, timeFactor: 2, sensing: "analytic" });
  await client.untilReady("TP-01");
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await system?.stop();
});

const ordersOfPlatform = async () => (await client.get("/api/v1/job-orders?vehicle=TP-01")).items;
const newestOf = async (name) => (await ordersOfPlatform()).filter((o) => o.created_by === name).sort((a, b) => b.number - a.number)[0];
/** Stopped some centimetres off its station a platform sees its codes no more and starts for nobody. */
const hasLeft = (v) => v.activity === "moving" && v.pose_basis.driven_m > 1;
const openOrders = async () => (await ordersOfPlatform()).filter((o) => !["Ended", "Aborted"].includes(o.state));
/** Nothing is under way or waits any more; what drives is cancelled last, and between stations. */
async function free() {
  await until("it is between stations, or has nothing to do", async () => (await openOrders()).length === 0 || hasLeft(await client.get("/api/v1/vehicles/TP-01")), { timeout_s: 60, every_ms: 100 });
  for (const order of (await openOrders()).sort((a, b) => (a.state === "Running") - (b.state === "Running"))) {
    await client.request("POST", `/api/v1/job-orders/${order.id}/cancel`);
    await client.untilEnded(order.id);
  }
  await client.untilVehicle("TP-01", (v) => !v.order && v.activity !== "moving", "has nothing to do");
}
// Whatever a test came to, the next one begins with nobody at the vehicle.
afterEach(async () => {
  for (const context of browser.contexts()) await context.close();
  await free();
});

const openSend = (name, station, options) => signedIn(browser, system, name, options).then(async (page) => {
  await page.goto(`${system.url}/send?vehicle=TP-01&station=${station}`);
  return page;
});
const go = (page) => page.locator("button.go");
const ready = (page) => until("it can be armed", async () => (await go(page).getAttribute("data-state")) === "ready", { timeout_s: 30, every_ms: 50 });
async function arm(page) {
  await ready(page);
  await page.locator("button.armed").click();
  await page.getByText(/[1-7] s left/).waitFor();
}
/** The other's drive: long enough for everything that is done meanwhile. */
async function sentBy(page, name) {
  await arm(page);
  await go(page).click();
  await page.locator(".move").waitFor();
  const order = await newestOf(name);
  await client.untilVehicle("TP-01", (v) => v.order === order.id && hasLeft(v), "drives for it");
  return order;
}
const onItsWay = (order, by) => new RegExp(`TP-01 is on its way to ${order.steps[0].number} \\(${order.name}, by ${by}, (there \\d\\d:\\d\\d:\\d\\d|late .+)\\)`);
/** Arms Replace; the words that are confirmed. */
async function armReplace(page) {
  const replace = page.locator(".busy .cmd");
  await until("Replace can be pressed", async () => (await replace.getAttribute("aria-disabled")) !== "true", { timeout_s: 30, every_ms: 50 });
  await replace.click();
  await page.locator(".busy .cmd[data-state=armed]", { hasText: /[1-7] s/ }).waitFor();
  return page.locator(".busy .cmd[data-state=armed]");
}

test("who presses second for a mode that leads there only from here is told why it is refused, and nothing is stored", async () => {
  const second = await openSend("anna", 3);
  await second.getByRole("radio", { name: /Fixed-axis rotation/ }).click({ timeout: 20_000 });
  let let_go;
  const stored = new Promise((done) => { let_go = done; });
  await second.route("**/api/v1/job-orders", async (route) => {
    if (route.request().method() === "POST") await stored;
    await route.continue();
  });
  const pressed = second.waitForRequest((request) => request.method() === "POST" && request.url().endsWith("/api/v1/job-orders"));
  await arm(second);
  await go(second).click();
  await pressed;
  await client.order("TP-01", [6]);
  let_go();
  await second.getByText("Refused").waitFor({ timeout: 10_000 });
  await second.getByText(/Station is .* off the heading line: the arc would need a radius of/).last().waitFor();
  await picture(second, "second-refused-1920");
  assert.equal(await newestOf("anna"), undefined, "what is refused is not stored");
});

test("at once the other page says who has the vehicle, and its move is stored behind that order", async () => {
  const [first, second] = [await openSend("operator", 6), await openSend("anna", 3, { bypassCSP: true })];
  await arm(second);
  await arm(first);
  await go(first).click();
  const order = await until("the first order is stored", () => newestOf("operator"), { timeout_s: 5, every_ms: 20 });
  await second.locator(".busy strong", { hasText: `${order.name}, by operator` }).waitFor({ timeout: 5000 });
  assert.notEqual(await go(second).getAttribute("data-state"), "armed", "what was armed was another move: one that begins at once");
  await client.untilVehicle("TP-01", (v) => v.activity === "moving", "drives");
  await second.locator(".busy strong", { hasText: onItsWay(order, "operator") }).waitFor({ timeout: 10_000 });
  await second.locator(".from", { hasText: `Seen from station 6, where TP-01 will stand after its orders (${order.name}).` }).waitFor({ timeout: 20_000 });
  await second.locator(".busy a", { hasText: `Show ${order.name}` }).click();
  await second.waitForURL(`**/orders/${order.id}`);
  await second.goBack();
  await second.locator(".busy").waitFor();
  await picture(second, "second-busy-1920");
  assert.deepEqual(await faultsOf(second), []);

  await arm(second);
  await go(second).click();
  await second.locator(".behind", { hasText: onItsWay(order, "operator") }).waitFor({ timeout: 10_000 });
  const behind = await newestOf("anna");
  await picture(second, "second-behind-1920");
  assert.equal(behind.state, "AllowedToStart", "it waits");
  assert.equal((await client.untilEnded(order.id)).state, "Ended", "the first order has come to its end");
  await second.locator(".move .now", { hasText: /On the way|measuring/ }).waitFor({ timeout: 20_000 });
  assert.equal(await second.locator(".behind").count(), 0);
  await first.locator(".move .now", { hasText: /Inside tolerance|Outside tolerance|Arrived/ }).waitFor();
  assert.deepEqual([...first.errors, ...second.errors], []);
});

test("Replace pressed twice: one order in the other's place, and the first operator sees by whom", async () => {
  const first = await openSend("operator", 7);
  const order = await sentBy(first, "operator");
  const second = await openSend("anna", 2);
  const replace = await armReplace(second);
  assert.match(await replace.innerText(), new RegExp(`Replace ${order.name} of operator`), "the order and its author are in what is confirmed");
  await picture(second, "second-replace-armed");
  await replace.dblclick();
  await first.locator(".move .now", { hasText: "anna cancels it: waits until TP-01 stands" }).or(first.locator(".move .now", { hasText: "Cancelled by anna" })).waitFor({ timeout: 10_000 });
  await second.locator(".behind", { hasText: new RegExp(`${order.name} of operator is (being )?cancelled`) }).waitFor({ timeout: 10_000 });
  await picture(second, "second-replacing");
  const ended = await client.untilEnded(order.id);
  assert.deepEqual([ended.state, ended.reason.code, ended.reason.params.actor], ["Aborted", "cancelled_by_person", "anna"]);
  const own = (await ordersOfPlatform()).filter((o) => o.created_by === "anna" && o.steps[0].number === 2);
  assert.equal(own.length, 1, "a double press is one order");
  await first.locator(".move .now", { hasText: "Ended without arriving: Cancelled by anna" }).waitFor({ timeout: 5000 });
  await first.locator(".behind", { hasText: `Instead of ${order.name}` }).waitFor();
  await picture(first, "second-cancelled-first");
  await second.locator(".move .now", { hasText: /On the way/ }).waitFor({ timeout: 20_000 });
  await first.locator(".behind", { hasText: onItsWay(own[0], "anna") }).waitFor({ timeout: 10_000 });
  assert.deepEqual([...first.errors, ...second.errors], []);
});

test("Replace of an order that has just ended by itself cancels nothing and says so", async () => {
  const first = await openSend("operator", 6);
  const order = await sentBy(first, "operator");
  const second = await openSend("anna", 3);
  let asked = 0;
  await second.route("**/job-orders/*/cancel", async (route) => {
    ++asked;
    await client.untilEnded(order.id); // the request was on its way while the vehicle arrived
    await route.continue();
  });
  const replace = await armReplace(second);
  await replace.click();
  await second.locator(".behind", { hasText: `${order.name} of operator had already ended` }).waitFor({ timeout: 60_000 });
  assert.equal(asked, 1);
  assert.equal((await client.get(`/api/v1/job-orders/${order.id}`)).state, "Ended");
  await second.locator(".move .now", { hasText: /On the way|Stored by the server/ }).waitFor();
  assert.deepEqual(second.errors, []);
});

test("the link cut between the two requests of Replace: nothing is lost, it says so, and the rest is done later", async () => {
  const first = await openSend("operator", 7);
  const order = await sentBy(first, "operator");
  const second = await openSend("anna", 3);
  await second.route("**/api/v1/job-orders", async (route) => {
    await second.context().setOffline(true); // before the stream tells of the new order: the page has its answer alone
    await route.fulfill({ response: await route.fetch() });
  });
  await (await armReplace(second)).click();
  const told = second.locator(".behind .failed");
  await told.waitFor({ timeout: 10_000 });
  const own = await newestOf("anna");
  assert.match(await told.innerText(), new RegExp(`${order.name} of operator was not cancelled: No connection.*Nothing is lost: ${own.name} is stored and begins when ${order.name} has ended`));
  await second.locator(".app[data-link=lost]").waitFor({ timeout: 5000 });
  await picture(second, "second-replace-cut");
  assert.equal((await client.get(`/api/v1/job-orders/${order.id}`)).state, "Running", "the other's order goes on");
  assert.equal((await client.get(`/api/v1/job-orders/${own.id}`)).state, "AllowedToStart");

  await second.unroute("**/api/v1/job-orders");
  await second.context().setOffline(false);
  await second.locator(".app:not([data-link])").waitFor({ timeout: 15_000 });
  await told.waitFor();
  const cancel = second.locator(".behind .cmd", { hasText: `Cancel ${order.name} of operator` });
  await cancel.click();
  await second.locator(".behind .cmd[data-state=armed]", { hasText: /[1-7] s/ }).click();
  assert.equal((await client.untilEnded(order.id)).reason.params.actor, "anna");
  await second.locator(".behind", { hasText: `${order.name} of operator is cancelled; ${own.name} has its place.` }).waitFor({ timeout: 5000 });
  await second.locator(".move .now", { hasText: "On the way" }).waitFor({ timeout: 20_000 });
  assert.deepEqual(second.errors, []);
});

test("both press Start at the same moment: one drives, the other waits behind it, and both pages say the same", async () => {
  const pages = { operator: await openSend("operator", 6), anna: await openSend("anna", 3) };
  // Straight ways lead to both stations from anywhere, whoever comes first.
  for (const page of Object.values(pages)) await page.getByRole("radio", { name: /Linear/ }).click({ timeout: 20_000 });
  // Neither request is let go before both are made: a page that has heard of the other's order drops what was armed.
  const sent = new Set();
  for (const [name, page] of Object.entries(pages)) await page.route("**/api/v1/job-orders", async (route) => {
    if (route.request().method() === "POST") {
      sent.add(name);
      await until("both have pressed", () => sent.size === 2, { timeout_s: 30, every_ms: 5 });
    }
    await route.continue();
  });
  // Where the machine is so slow that the seconds of an armed button are over first, nothing is sent and it is pressed again.
  await until("both orders are on their way", async () => {
    const left = Object.entries(pages).filter(([name]) => !sent.has(name)).map(([, page]) => page);
    await Promise.all(left.map(arm));
    await Promise.all(left.map((page) => go(page).click()));
    return until("they are sent", () => sent.size === 2, { timeout_s: 2 }).catch(() => false);
  }, { timeout_s: 40 });
  let found = [];
  const both = await until(() => `both orders are stored, not ${JSON.stringify(found)}`, async () => {
    found = [await newestOf("operator"), await newestOf("anna")];
    return found.every((o) => o && !["Ended", "Aborted"].includes(o.state)) && found;
  }, { timeout_s: 10, every_ms: 50 });
  const driving = await until("one of them has the vehicle", async () => {
    const { order } = await client.get("/api/v1/vehicles/TP-01");
    return both.find((o) => o.id === order);
  }, { timeout_s: 10, every_ms: 50 });
  const waiting = both.find((o) => o !== driving);
  await client.untilVehicle("TP-01", (v) => v.activity === "moving", "drives");
  const name = (order) => order.created_by;
  await pages[name(waiting)].locator(".behind", { hasText: onItsWay(driving, name(driving)) }).waitFor({ timeout: 10_000 });
  await pages[name(driving)].locator(".move .now", { hasText: "On the way" }).waitFor({ timeout: 10_000 });
  assert.equal(await pages[name(driving)].locator(".behind").count(), 0);
  assert.equal((await client.get(`/api/v1/job-orders/${waiting.id}`)).state, "AllowedToStart");
  for (const page of Object.values(pages)) assert.deepEqual(page.errors, []);
});

test("at three sizes and in both languages the note fits, and all of it is in reach", async () => {
  const order = await client.order("TP-01", [7, 2, 7, 2]); // long enough for four pages
  await client.untilVehicle("TP-01", (v) => v.activity === "moving", "drives");
  for (const [width, height, lang, theme] of [[390, 844, "zh", "light"], [390, 844, "en", "dark"], [1024, 768, "en", "light"], [1920, 1080, "zh", "dark"]]) {
    const page = await openSend("anna", 3, { width, height, lang, theme, bypassCSP: true });
    await page.locator(".busy strong", { hasText: order.name }).waitFor();
    await page.locator(".from").waitFor({ timeout: 20_000 });
    await picture(page, `second-note-${width}-${theme}-${lang}`);
    assert.deepEqual(await reachFaultsOf(page), [], `${width} ${lang}`);
    assert.deepEqual(await faultsOf(page, { without: ["target-size"] }), []);
    await page.context().close();
  }
});

test("an open Send page asks the planner nothing while nothing changes, while its move is shown, or while nobody sees it", async () => {
  const page = await openSend("operator", 3);
  let asked = 0;
  page.on("request", (request) => { asked += request.url().includes("dryRun=true") ? 1 : 0; });
  const heard = async (frames) => { // so many frames of the stream have come: time that the page counts itself by
    let seen = 0;
    const client_ = await page.context().newCDPSession(page);
    await client_.send("Network.enable");
    client_.on("Network.webSocketFrameReceived", () => ++seen);
    await until("the stream goes on", () => seen >= frames, { timeout_s: 30, every_ms: 50 });
    await client_.detach();
  };
  await until("it is ready", async () => (await go(page).getAttribute("data-state")) === "ready", { timeout_s: 30, every_ms: 50 });
  asked = 0;
  await heard(30);
  assert.equal(asked, 0, "nothing has changed");

  const order = await client.order("TP-01", [3]);
  await page.goto(`${system.url}/send?vehicle=TP-01&station=3&order=${order.id}`);
  await page.locator(".move .now", { hasText: "On the way" }).waitFor({ timeout: 20_000 });
  asked = 0;
  await heard(30);
  assert.equal(asked, 0, "the move is shown, the preview is not");
  await page.context().close();
  await free();

  const hidden = await signedIn(browser, system, "operator");
  await hidden.addInitScript(() => Object.defineProperty(document, "visibilityState", { get: () => globalThis.seen ?? "hidden" }));
  let questions = 0;
  hidden.on("request", (request) => { questions += request.url().includes("dryRun=true") ? 1 : 0; });
  await hidden.goto(`${system.url}/send?vehicle=TP-01&station=2`);
  await hidden.locator(".disp b", { hasText: "2" }).waitFor();
  await hidden.locator(".shell").getByText(/Live/).waitFor();
  assert.equal(questions, 0, "nobody sees it");
  await hidden.evaluate(() => { globalThis.seen = "visible"; document.dispatchEvent(new Event("visibilitychange")); });
  await hidden.locator(".mode[role=radio]").first().waitFor({ timeout: 20_000 });
  assert.ok(questions > 0);
});

test("signed out elsewhere: the page says why, and comes back to the vehicle and the station that had been chosen", async () => {
  const page = await signedIn(browser, system, "anna");
  await page.goto(`${system.url}/send`);
  await page.locator(".veh.pick, .vrow").first().waitFor();
  const row = page.getByRole("option", { name: /^TP-01/ });
  if (await row.count() > 0) await row.click();
  await page.keyboard.type("12");
  await page.keyboard.press("Backspace");
  await page.keyboard.type("5"); // nothing had the focus but the row that was pressed
  await page.locator(".disp b", { hasText: "15" }).waitFor();
  await page.keyboard.press("Backspace");
  await page.keyboard.press("Backspace");
  await page.keyboard.type("2");
  await page.waitForURL(/\/send\?vehicle=TP-01&station=2$/);
  const { csrf_token } = await (await page.request.get(`${system.url}/api/v1/session`)).json();
  await page.request.delete(`${system.url}/api/v1/session`, { headers: { "X-Pulseline-CSRF": csrf_token } });
  const told = page.locator(".ended");
  await told.waitFor({ timeout: 5000 });
  assert.match(await told.innerText(), /The server ended the session of anna at \d\d:\d\d:\d\d\.\s+It was signed out elsewhere, an administrator changed the account, or it had lasted too long\./);
  assert.equal(await page.locator("input[name=username]").inputValue(), "anna");
  await picture(page, "session-ended-1920");
  for (const [width, height] of [[1024, 768], [390, 844], [1920, 1080]]) {
    await page.setViewportSize({ width, height });
    assert.deepEqual(await reachFaultsOf(page, { pause: false }), [], `${width}`);
    if (width < 1920) await picture(page, `session-ended-${width}`);
  }
  await page.locator("input[type=password]").fill(system.passwords.get("anna"));
  await page.locator("button[type=submit]").click();
  await page.waitForURL(/\/send\?vehicle=TP-01&station=2$/);
  await page.locator(".vrow b", { hasText: "TP-01" }).waitFor();
  await page.locator(".disp b", { hasText: "2" }).waitFor();

  // Who signs out here is told nothing: that person knows.
  await page.locator(".who > button").click();
  await page.locator(".menu").getByRole("button", { name: "Sign out" }).click();
  await page.locator("input[name=username]").waitFor();
  assert.equal(await page.locator(".ended").count(), 0);
  assert.deepEqual(page.errors, []);
});

test("an account changed by the administrator while the server was down: the page that comes back says that its session has ended", async () => {
  const page = await openSend("anna", 2, { lang: "zh" });
  await page.locator(".disp b", { hasText: "2" }).waitFor();
  await system.kill(system.server);
  await page.locator(".app[data-link=lost]").waitFor({ timeout: 5000 });
  addUser("anna", "another-password-of-anna");
  await system.startServer();
  await page.locator(".ended", { hasText: /服务器于 \d\d:\d\d:\d\d 结束了 anna 的会话/ }).waitFor({ timeout: 20_000 });
  await picture(page, "session-ended-zh");
  await page.reload();
  await page.locator(".ended").waitFor({ timeout: 15_000 });
  await page.locator("input[type=password]").fill(system.passwords.get("anna"));
  await page.locator("button[type=submit]").click();
  await page.locator(".disp b", { hasText: "2" }).waitFor({ timeout: 15_000 });
  assert.deepEqual(page.errors, []);
});
