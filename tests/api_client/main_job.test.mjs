// The main job as a headless client sees it: one order over REST, its events, its stop; and bad input.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";

let system, client;
before(async () => {
  system = await System.create("pulse-line");
  system.prepareVehicles(["TP-01"]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  system.startAgent("TP-01", { seed: 5, sensing: "analytic" });
  await client.untilReady("TP-01");
});
after(() => system?.stop());

const post = (body, headers) => client.request("POST", "/api/v1/job-orders", { ...(typeof body === "string" ? { raw: body } : { body }), headers });

test("an order over REST ends with a measured stop inside tolerance", async () => {
  const answer = await post({ vehicle: "TP-01", client_order_id: "MES-1", steps: [{ station: 2, motion_mode: "linear" }] });
  assert.equal(answer.status, 201);
  assert.equal(answer.headers.get("location"), `/api/v1/job-orders/${answer.body.id}`);
  assert.match(answer.headers.get("etag"), /^"\d+"$/);
  assert.ok(answer.headers.get("x-request-id"));
  const order = await client.untilEnded(answer.body.id);
  assert.equal(order.state, "Ended");
  const [stop] = (await client.stops(order.id)).slice(-1);
  assert.ok(stop.inside);
  assert.ok(Math.abs(stop.dx_m) <= 0.025 && Math.abs(stop.dy_m) <= 0.025 && Math.abs(stop.dheading_rad) <= 0.2 * Math.PI / 180);
  const station = await client.get("/api/v1/stations/2");
  assert.equal(station.occupied_by, "TP-01");
  assert.equal(station.ready, true);
  const types = (await client.events()).filter((e) => e.order === order.id).map((e) => e.type);
  for (const type of ["job_order.created", "step.started", "leg.accepted", "stop.measured", "job_order.state"]) assert.ok(types.includes(type), `${type} in ${types}`);
});

test("a dry run answers every motion mode and stores nothing", async () => {
  const before = (await client.get("/api/v1/job-orders")).items.length;
  const answer = await client.request("POST", "/api/v1/job-orders?dryRun=true", { body: { vehicle: "TP-01", steps: [{ station: 3 }] } });
  assert.equal(answer.status, 200);
  assert.equal(answer.body.accepted, true);
  const [step] = answer.body.steps;
  const modes = Object.fromEntries(step.options.map((o) => [o.mode, o]));
  assert.equal(modes.linear.feasible, true);
  assert.ok(modes.linear.duration_s > 0 && modes.linear.swept.length > 0 && modes.linear.clearance_m > 0);
  assert.equal(modes.self_rotation.feasible, false);
  assert.equal(modes.self_rotation.reason.code, "not_in_place");
  assert.equal(step.options.filter((o) => o.suggested).length, 1);
  assert.ok(answer.body.checks.some((c) => c.code === "codes_in_view"));
  assert.equal((await client.get("/api/v1/job-orders")).items.length, before);
});

test("the same key with the same body is one order, with another body a problem", async () => {
  const body = { vehicle: "TP-01", steps: [{ station: 3 }] };
  const first = await post(body, { "Idempotency-Key": "k-1" });
  const again = await Promise.all([1, 2, 3].map(() => post(body, { "Idempotency-Key": "k-1" })));
  for (const answer of again) assert.equal(answer.body.id, first.body.id);
  const other = await post({ ...body, priority: 5 }, { "Idempotency-Key": "k-1" });
  assert.equal(other.status, 422);
  assert.equal(other.body.code, "idempotency_key_reused");
  assert.equal((await client.untilEnded(first.body.id)).state, "Ended");
});

test("fixed-axis rotation to a target on the heading line is refused with radius and limit", async () => {
  // Station 6 heads east and station 7 lies due east of it: Tang's equation 7.
  const there = await client.order("TP-01", [4, 5, 6]);
  assert.equal((await client.untilEnded(there.id, 120)).state, "Ended");
  const answer = await post({ vehicle: "TP-01", steps: [{ station: 7, motion_mode: "fixed_axis_rotation" }] });
  assert.equal(answer.status, 422);
  assert.equal(answer.body.code, "target_on_heading_line");
  assert.equal(answer.body.field, "/steps/0/motion_mode");
  assert.ok("limit_m" in answer.body.params);
});

const BAD = [
  ["unknown station", { vehicle: "TP-01", steps: [{ station: 99 }] }, 422, "unknown_station", "/steps/0/station"],
  ["unknown vehicle", { vehicle: "TP-99", steps: [{ station: 2 }] }, 422, "unknown_vehicle", "/vehicle"],
  ["no steps", { vehicle: "TP-01", steps: [] }, 400, null, "/steps"],
  ["wrong type", { vehicle: "TP-01", steps: [{ station: "2" }] }, 400, null, "/steps/0/station"],
  ["unknown mode", { vehicle: "TP-01", steps: [{ station: 2, motion_mode: "fly" }] }, 400, null, "/steps/0/motion_mode"],
  ["extra field", { vehicle: "TP-01", steps: [{ station: 2 }], colour: "red" }, 400, null, "/colour"],
  ["duplicate key", '{"steps":[{"station":2}],"steps":[{"station":3}]}', 400, null, null],
  ["not JSON", "station 2 please", 400, null, null],
  ["empty", "", 400, null, null],
  ["deep brackets", "[".repeat(300 * 1024), 413, null, null],
  ["deep brackets within the limit", "[".repeat(200 * 1024), 400, null, null],
  ["not finite", '{"steps":[{"station":1e999}]}', 400, null, null],
];
for (const [name, body, status, code, field] of BAD) {
  test(`bad input: ${name} is answered with a clear problem`, async () => {
    const answer = await post(body);
    assert.equal(answer.status, status, JSON.stringify(answer.body));
    assert.match(answer.type, /^application\/problem\+json/);
    assert.equal(answer.body.type, `urn:pulseline:problem:${answer.body.code}`);
    assert.ok(answer.body.detail.length > 10);
    if (code) assert.equal(answer.body.code, code);
    if (field) assert.equal(answer.body.field, field);
    const health = await client.request("GET", "/healthz");
    assert.equal(health.status, 200);
  });
}

test("without a token nothing is told, with a viewer's session nothing is changed", async () => {
  assert.equal((await new Client(system.url).request("GET", "/api/v1/vehicles")).status, 401);
  const signIn = await new Client(system.url).request("POST", "/api/v1/session", { body: { name: "viewer", password: system.passwords.get("viewer") } });
  assert.equal(signIn.status, 200);
  const cookie = signIn.headers.get("set-cookie").split(";")[0];
  assert.match(signIn.headers.get("set-cookie"), /HttpOnly/);
  const headers = { Cookie: cookie, "X-Pulseline-CSRF": signIn.body.csrf_token };
  const anonymous = new Client(system.url);
  assert.equal((await anonymous.request("GET", "/api/v1/vehicles", { headers })).status, 200);
  assert.equal((await anonymous.request("POST", "/api/v1/job-orders", { body: { steps: [{ station: 2 }] }, headers })).status, 403);
});

test("a session's change without its CSRF token is refused", async () => {
  const signIn = await new Client(system.url).request("POST", "/api/v1/session", { body: { name: "operator", password: system.passwords.get("operator") } });
  const headers = { Cookie: signIn.headers.get("set-cookie").split(";")[0] };
  const answer = await new Client(system.url).request("POST", "/api/v1/fleet/pause", { headers });
  assert.equal(answer.status, 403);
});

test("metrics and the document of the API are served", async () => {
  const metrics = await client.request("GET", "/metrics");
  assert.match(metrics.body, /^# TYPE pulseline_/m);
  const document = await new Client(system.url).request("GET", "/api/v1/openapi.json");
  assert.equal(document.body.openapi, "3.1.0");
});

test("paging through job orders shows each once", async () => {
  const seen = [];
  let cursor = "";
  do {
    const page = await client.get(`/api/v1/job-orders?limit=2${cursor && `&cursor=${encodeURIComponent(cursor)}`}`);
    seen.push(...page.items.map((o) => o.number));
    cursor = page.next_cursor ?? "";
  } while (cursor);
  assert.deepEqual(seen, [...seen].sort((a, b) => b - a));
  assert.equal(new Set(seen).size, seen.length);
  assert.ok(seen.length >= 3);
});
