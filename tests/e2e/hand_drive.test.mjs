// A person drives a platform by hand from the dashboard, in Chromium against the real server and a real agent: with keys and with
// two fingers, at three sizes, in both languages and themes; with two people at once, with an order under way, with the line cut.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { angleBetween } from "../harness/client.mjs";
import { hallWith } from "../harness/one_vehicle.mjs";
import { until } from "../harness/processes.mjs";
import { decide, faultsOf, picture, signedIn } from "../harness/browser.mjs";
import { overlapsOf, reachFaultsOf } from "../harness/reach.mjs";

const kId = "TP-01";
let hall, system, client, browser;

before(async () => {
  hall = await hallWith(kId, { users: ["operator", "engineer", "viewer"], agent: { seed: 22, timeFactor: 4, sensing: "analytic" } });
  ({ system, client, browser } = hall);
});
after(() => hall?.stop());

const open = (role, how = {}) => signedIn(browser, system, role, { path: `/drive/${kId}`, bypassCSP: true, ...how });
const truth = () => system.lastTruth(kId);
const stands = () => until("it stands", () => truth().moving === false);
const command = (page, name) => page.locator(".nextsteps .cmd", { hasText: name });
const isMine = (page) => page.locator(".desk[data-mine=true]").waitFor();
/** Its way since then in its own frame of then. */
const moved = (from) => {
  const now = truth(), [dx, dy] = [now.x_m - from.x_m, now.y_m - from.y_m], [c, s] = [Math.cos(from.heading_rad), Math.sin(from.heading_rad)];
  return { ahead_m: c * dx + s * dy, left_m: c * dy - s * dx, turn_rad: angleBetween(now.heading_rad, from.heading_rad) };
};
const take = async (page, name = "Take it in hand") => {
  await command(page, name).click();
  await isMine(page);
};
const giveBack = async (page, name = "Give it back") => {
  await stands();
  await until("it can be given back", async () => (await command(page, name).getAttribute("data-state")) === "ready");
  await command(page, name).click();
  await client.untilVehicle(kId, (v) => v.operating_mode === "AUTOMATIC" && v.in_hand_of === undefined, "is its own again");
};
const letGoOn = (page, name = "Resume") => decide(page, page.locator(".nextsteps .held .cmd", { hasText: name }));

test("with the keyboard: held and pressed it moves as asked, let go it stands, sideways and turning together", async () => {
  const page = await open("operator");
  await take(page);
  await client.untilVehicle(kId, (v) => v.in_hand_of === "operator" && v.needs_resume, "is in the operator's hands, everywhere");
  let from = truth();
  await page.keyboard.down("ArrowUp");
  await page.keyboard.down("Space"); // the direction came before the hold: it does not count
  await page.locator(".desk .says", { hasText: "Choose a direction" }).waitFor();
  assert.ok(Math.abs(moved(from).ahead_m) < 1e-3);
  await page.keyboard.up("ArrowUp");

  await page.keyboard.down("ArrowUp");
  await until("it has gone ahead", () => moved(from).ahead_m > 0.3);
  await page.keyboard.up("Space");
  await page.locator(".desk .says", { hasText: "It stands" }).waitFor();
  await stands();
  from = truth();
  await page.keyboard.up("ArrowUp");

  await page.keyboard.press("Digit3");
  await page.keyboard.down("Space");
  await page.keyboard.down("KeyA");
  await page.keyboard.down("KeyE");
  await until("it has gone left and turned right together", () => moved(from).left_m > 0.5 && moved(from).turn_rad < -0.02);
  await page.evaluate(() => window.dispatchEvent(new Event("blur")));
  await stands();
  for (const key of ["KeyA", "KeyE", "Space"]) await page.keyboard.up(key);
  await giveBack(page);
  await letGoOn(page);
  await client.untilVehicle(kId, (v) => !v.needs_resume, "may go on");
  await page.locator(".nextsteps a", { hasText: "Send it" }).waitFor();
  assert.deepEqual(page.errors, []);
  await page.context().close();
});

test("with two fingers on a tablet; another finger than the hold's leaves it standing", async () => {
  const page = await open("operator", { width: 1024, height: 768, lang: "zh", theme: "dark" });
  await take(page, "接管车辆");
  const touch = await page.context().newCDPSession(page);
  const middle = async (label) => {
    const { x, y, width, height } = await page.locator(`[aria-label="${label}"]`).boundingBox();
    return { x: x + width / 2, y: y + height / 2 };
  };
  const [hold, back] = [{ ...(await middle("驾驶时按住")), id: 1 }, { ...(await middle("后退")), id: 2 }];
  const fingers = (type, ...touchPoints) => touch.send("Input.dispatchTouchEvent", { type, touchPoints });
  const from = truth();
  await fingers("touchStart", back);
  await fingers("touchEnd");
  assert.ok(Math.abs(moved(from).ahead_m) < 1e-3, "no hold, no way");
  await fingers("touchStart", hold);
  await fingers("touchStart", hold, back);
  await until("it has gone back", () => moved(from).ahead_m < -0.3);
  await picture(page, "drive-1024-zh-dark");
  await fingers("touchEnd", back); // the thumb leaves the hold
  await stands();
  await fingers("touchEnd");
  assert.deepEqual(await overlapsOf(page), []);
  await giveBack(page, "交还控制");
  await letGoOn(page, "恢复");
  assert.deepEqual(page.errors, []);
  await page.context().close();
});

test("who has it in hand is told on the map, in the list of vehicles and where it is to be sent", async () => {
  const ann = await open("operator"), bob = await open("engineer", { path: "/map" });
  const says = (where, words = "In the hands of operator") => bob.locator(where, { hasText: words }).first().waitFor();
  const goTo = (path, lang = "en") => bob.goto(`${system.url}${path}${path.includes("?") ? "&" : "?"}lang=${lang}`);
  await goTo("/map?vehicle=TP-01");
  await bob.locator(".vcard").waitFor();
  assert.equal(await bob.getByText("In the hands of").count(), 0);
  await take(ann);
  await says(".vcard .hands");
  await says(".veh[data-vehicle=TP-01] .what");
  await picture(bob, "in_hand-map-1920-en");
  assert.deepEqual(await overlapsOf(bob), []);
  assert.deepEqual(await reachFaultsOf(bob), []);
  await goTo("/vehicles");
  await says(".vrows .hand");
  await picture(bob, "in_hand-list-1920-en");
  assert.deepEqual(await reachFaultsOf(bob), []);
  await goTo("/send?vehicle=TP-01&station=2");
  await says(".vrow .hand");
  await says(".checks .chk", "Driven by hand by operator");
  await picture(bob, "in_hand-send-1920-en");
  assert.deepEqual(await overlapsOf(bob), []);
  await bob.setViewportSize({ width: 1024, height: 768 });
  await goTo("/map?vehicle=TP-01", "zh");
  await says(".vcard .hands", "由 operator 手动控制");
  await picture(bob, "in_hand-map-1024-zh");
  assert.deepEqual(await overlapsOf(bob), []);
  assert.deepEqual(await reachFaultsOf(bob), []);
  await goTo("/vehicles", "zh");
  await says(".vrows .hand", "由 operator 手动控制");
  await giveBack(ann);
  await letGoOn(ann);
  await until("nobody has it any more", async () => (await bob.locator(".vrows .hand").count()) === 0);
  assert.deepEqual([...ann.errors, ...bob.errors], []);
  await ann.context().close();
  await bob.context().close();
});

test("two people at once: the second reads who has it, moves nothing, and has it when the first has gone", async () => {
  const ann = await open("operator"), bob = await open("engineer");
  await take(ann);
  await bob.locator(".nextsteps", { hasText: "operator has it in hand" }).waitFor();
  await command(bob, "Take it in hand").click();
  await bob.locator(".failedline", { hasText: "operator has the vehicle in hand" }).waitFor();
  const from = truth();
  await bob.evaluate(() => document.activeElement.blur()); // Space would press the button again
  await bob.keyboard.down("Space");
  await bob.keyboard.down("ArrowUp");
  await ann.keyboard.down("Space");
  await ann.keyboard.down("ArrowDown");
  await until("it goes back", () => moved(from).ahead_m < -0.2);
  const faceplate = await signedIn(browser, system, "viewer", { path: `/vehicles/${kId}` });
  await faceplate.locator(".chip", { hasText: "In the hands of operator" }).waitFor();
  assert.equal(await faceplate.locator("a", { hasText: "Drive by hand" }).count(), 0, "a viewer drives nothing");
  await ann.context().close(); // her tablet is gone, the finger still down
  await stands();
  assert.equal((await client.get(`/api/v1/vehicles/${kId}`)).operating_mode, "MANUAL");
  for (const key of ["ArrowUp", "Space"]) await bob.keyboard.up(key);
  await until("it can be asked again", async () => (await command(bob, "Take it in hand").getAttribute("data-state")) !== "requested");
  await take(bob);
  await client.untilVehicle(kId, (v) => v.in_hand_of === "engineer", "is in the other's hands");
  await giveBack(bob);
  await letGoOn(bob);
  await client.untilVehicle(kId, (v) => !v.needs_resume, "may go on");
  await Promise.all([bob, faceplate].map((page) => page.context().close()));
});

test("taken in the middle of an order it stands, and given back the order goes on where a person says so", async () => {
  const order = await client.order(kId, [3]);
  await until("it drives", () => truth().moving === true);
  const page = await open("operator");
  await decide(page, command(page, "Take it in hand"));
  await isMine(page);
  const interrupted = await client.untilOrder(order.id, (o) => o.state === "Interrupted", "is interrupted");
  assert.deepEqual([interrupted.reason.code, interrupted.reason.params.person], ["driven_by_hand", "operator"]);
  await stands();
  await picture(page, "drive-1920-en-light");
  assert.deepEqual(await faultsOf(page), []);
  assert.deepEqual(await reachFaultsOf(page), []);
  assert.deepEqual(await overlapsOf(page), []);
  const from = truth();
  await page.keyboard.down("Space");
  await page.keyboard.down("ArrowDown");
  await until("it has gone back", () => moved(from).ahead_m < -0.2);
  for (const key of ["ArrowDown", "Space"]) await page.keyboard.up(key);
  await giveBack(page);
  await letGoOn(page);
  assert.equal((await client.untilEnded(order.id, 120)).state, "Ended");
  await page.context().close();
});

test("Pause fleet has it brake under the finger, and only who lets go and presses again moves it", async () => {
  const page = await open("operator"), other = await signedIn(browser, system, "engineer", { path: "/map" });
  await take(page);
  let from = truth();
  await page.keyboard.down("Space");
  await page.keyboard.down("ArrowDown");
  await until("it goes back", () => moved(from).ahead_m < -0.2);
  await other.locator("button.pause").click();
  await page.locator(".desk .says", { hasText: "let go, look at it" }).waitFor();
  await stands();
  from = truth();
  for (const key of ["ArrowDown", "Space"]) await page.keyboard.up(key);
  await page.keyboard.down("Space");
  await page.keyboard.down("ArrowUp");
  await until("it goes where somebody wants it on purpose", () => moved(from).ahead_m > 0.1);
  for (const key of ["ArrowUp", "Space"]) await page.keyboard.up(key);
  await giveBack(page);
  await letGoOn(page);
  await client.post("/api/v1/fleet/resume", { vehicles: [kId] }).catch(() => undefined);
  await client.untilVehicle(kId, (v) => !v.needs_resume && !v.paused, "may go on");
  await Promise.all([page, other].map((one) => one.context().close()));
});

test("on its feet it is not moved, and the page says why; raised it moves", async () => {
  const page = await open("operator");
  const feet = async (type) => {
    const { lift } = await client.post(`/api/v1/vehicles/${kId}/lifts`, { type });
    await client.untilVehicle(kId, (v) => v.lift?.action_id === lift.action_id && v.lift.state === "done", type, 60);
  };
  await feet("lowerParking");
  await take(page);
  const from = truth();
  await page.keyboard.down("Space");
  await page.keyboard.down("ArrowUp");
  await page.locator(".desk .says.bad", { hasText: "stands on its feet" }).waitFor();
  assert.ok(Math.abs(moved(from).ahead_m) < 1e-3);
  for (const key of ["ArrowUp", "Space"]) await page.keyboard.up(key);
  await giveBack(page);
  await letGoOn(page);
  await client.untilVehicle(kId, (v) => !v.needs_resume, "may go on");
  await feet("raiseParking");
  await page.context().close();
});

test("the server dies under a pressed finger: it stands, and taken anew it goes on", async () => {
  const page = await open("operator");
  await take(page);
  const from = truth();
  await page.keyboard.down("Space");
  await page.keyboard.down("ArrowUp");
  await until("it goes ahead", () => moved(from).ahead_m > 0.2);
  await system.kill(system.server);
  await stands();
  await page.locator(".desk .says.bad").waitFor();
  await picture(page, "drive-cut-1920-en-light");
  await system.startServer();
  await page.locator(".desk .says", { hasText: "Take it in hand first" }).waitFor({ timeout: 30_000 });
  const stood = truth();
  for (const key of ["ArrowUp", "Space"]) await page.keyboard.up(key);
  await until("it can be asked again", async () => (await command(page, "Take it in hand").getAttribute("data-state")) === "ready");
  await take(page);
  assert.ok(Math.abs(moved(stood).ahead_m) < 1e-3, "nothing moved by itself");
  await giveBack(page);
  await page.context().close();
});

test("a small screen and one without a vehicle have words, too", async () => {
  const page = await open("operator", { width: 390, height: 844, theme: "dark" });
  await page.locator(".desk").waitFor();
  await picture(page, "drive-390-en-dark");
  assert.deepEqual(await overlapsOf(page), []);
  await page.context().close();
  const none = await signedIn(browser, system, "operator", { path: "/drive/NO-99" });
  await none.locator(".shell").waitFor();
  await none.getByText("NO-99").first().waitFor();
  await none.context().close();
});
