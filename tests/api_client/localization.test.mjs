// Images over REST: what is found in them, and who may send how much.
import assert from "node:assert/strict";
import { readdirSync } from "node:fs";
import { request } from "node:http";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";

let system, client;
before(async () => {
  system = await System.create("pulse-line");
  await system.startServer();
  client = new Client(system.url, system.apiToken);
});
after(() => system?.stop());

const WIDTH = 1280, HEIGHT = 1024;
const grey = (value) => Buffer.concat([Buffer.from(`P5\n${WIDTH} ${HEIGHT}\n255\n`), Buffer.alloc(WIDTH * HEIGHT, value)]).toString("base64");
const ask = (body, headers) => client.request("POST", "/api/v1/localizations", { body, headers });

test("an image takes the thread that has it and no other of the machine's cores", async () => {
  const threads = () => readdirSync(`/proc/${system.server.pid}/task`).length;
  await client.get("/api/v1/vehicles"); // the server has all its own threads
  const before = threads();
  assert.equal((await ask({ vehicle: "TP-01", images: [{ camera: "front", image: grey(128) }] })).status, 200);
  assert.equal(threads(), before);
});

test("images without a code are answered with the reason and a picture of each", async () => {
  const answer = await ask({ vehicle: "TP-01", images: [{ camera: "front", image: grey(0) }, { camera: "back", image: grey(255) }] });
  assert.equal(answer.status, 200, JSON.stringify(answer.body));
  assert.equal(answer.body.reason.code, "no_marker_in_view");
  assert.deepEqual(answer.body.cameras.map(({ camera, found, reason }) => [camera, found, reason.code]), [["front", false, "no_code"], ["back", false, "no_code"]]);
  for (const { picture } of answer.body.cameras) assert.equal(Buffer.from(picture, "base64").subarray(0, 2).toString("hex"), "ffd8");
});

test("what is no image, no base64 or no camera is refused with its field", async () => {
  const refused = async (image, vehicle = "TP-01") => {
    const { status, body } = await ask({ vehicle, images: [image] });
    return [status, body.code, body.field];
  };
  assert.deepEqual(await refused({ camera: "front", image: Buffer.from("no image").toString("base64") }), [422, "image_unreadable", "/images/0/image"]);
  assert.deepEqual(await refused({ camera: "front", image: "***" }), [400, "not_base64", "/images/0/image"]);
  assert.deepEqual(await refused({ camera: "side", image: grey(0) }), [422, "unknown_camera", "/images/0/camera"]);
  assert.deepEqual(await refused({ camera: "front", image: grey(0) }, "TP-99"), [422, "unknown_vehicle", "/vehicle"]);
});

test("a stranger, and any other address, gets no more than the usual body", async () => {
  const body = JSON.stringify({ vehicle: "TP-01", images: [{ camera: "front", image: grey(0) }] });
  const send = (path, headers) => fetch(`${system.url}${path}`, { method: "POST", body, headers: { "Content-Type": "application/json", ...headers } }).then((answer) => answer.status, () => "cut off");
  const mine = { Authorization: `Bearer ${client.token}` };
  assert.equal(await send("/api/v1/localizations", mine), 200);
  // Nothing is read of a stranger's body; the answer may be lost in what they still send.
  assert.ok([401, "cut off"].includes(await send("/api/v1/localizations", {})));
  assert.equal(await send("/api/v1/routes", mine), 413);
  // Who asks first is told before the body is sent.
  const headers = { ...mine, "Content-Type": "application/json", "Content-Length": String(9 << 20), Expect: "100-continue" };
  const refused = await new Promise((done, fail) => {
    const asked = request(`${system.url}/api/v1/localizations`, { method: "POST", headers }, (response) => {
      let text = "";
      response.setEncoding("utf8").on("data", (part) => { text += part; }).on("end", () => { asked.destroy(); done({ status: response.statusCode, body: JSON.parse(text) }); });
    });
    asked.on("error", fail).flushHeaders();
  });
  assert.equal(refused.status, 413);
  assert.equal(refused.body.params.limit_bytes, 8 << 20);
});
