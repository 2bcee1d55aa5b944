// Receivers of iGPS on no vehicle: their places by the passing of the transmitters' light, which this test works out by itself.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";

let system, client, transmitters;
before(async () => {
  system = await System.create("igps-cell");
  await system.startServer();
  client = new Client(system.url, system.apiToken);
  ({ transmitters } = await client.get("/api/v1/plant"));
});
after(() => system?.stop());

const measure = (receivers, hall = "cell") => client.request("POST", "/api/v1/igps/measurements", { body: { hall, receivers } });

/** Angle of the head at which a sheet passes the point; side +1: it shines to the left of (a, b). The plant's heads stand level. */
function passing({ a, b, offset_m }, [x, y, z], side) {
  const share = -(z + offset_m) / (Math.hypot(x, y) * Math.hypot(a, b));
  const angle = Math.atan2(y, x) - Math.atan2(b, a) - side * Math.acos(share);
  return ((angle % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI);
}

function turn(transmitter, [x, y, z], zero_s = 100) {
  const { position, z_m, heading_rad: h, rate_hz } = transmitter;
  assert.deepEqual([transmitter.roll_rad, transmitter.pitch_rad], [0, 0]);
  const [dx, dy] = [x - position.x_m, y - position.y_m];
  const seen = [Math.cos(h) * dx + Math.sin(h) * dy, -Math.sin(h) * dx + Math.cos(h) * dy, z - z_m];
  const at = (sheet, side) => zero_s + passing(sheet, seen, side) / (2 * Math.PI) / rate_hz;
  return { transmitter: transmitter.id, zero_s, next_zero_s: zero_s + 1 / rate_hz, first_s: at(transmitter.first, 1), second_s: at(transmitter.second, -1) };
}

test("balls on a jig are measured to some hundredths of a millimetre", async () => {
  const balls = { "ball 1": [12.34, 6.5, 0.8], "ball 2": [20.1, 11.25, 1.9] };
  const { status, body } = await measure(Object.entries(balls).map(([receiver, place]) => ({ receiver, turns: transmitters.map((one) => turn(one, place)) })));
  assert.equal(status, 200, JSON.stringify(body));
  assert.deepEqual(body.measurements.map((one) => one.receiver), Object.keys(balls));
  for (const { receiver, found, place, sigma, transmitters: used } of body.measurements) {
    assert.ok(found);
    const [x, y, z] = balls[receiver];
    // The clock has 15 digits and a head turns in 25 ms.
    assert.ok(Math.hypot(place.x_m - x, place.y_m - y, place.z_m - z) < 1e-6, JSON.stringify(place));
    for (const axis of ["x_m", "y_m", "z_m"]) assert.ok(sigma[axis] > 1e-5 && sigma[axis] < 3e-4, JSON.stringify(sigma));
    assert.equal(used.length, transmitters.length);
  }
});

test("a transmitter that contradicts the others is named and left out", async () => {
  const place = [16, 9.9, 1.2];
  const pushed = { ...transmitters[3], heading_rad: transmitters[3].heading_rad + 0.001 };
  const turns = transmitters.map((one, i) => turn(i === 3 ? pushed : one, place));
  const { body } = await measure([{ receiver: "ball", turns }]);
  assert.equal(body.measurements[0].refused, transmitters[3].id);
  assert.ok(Math.hypot(body.measurements[0].place.x_m - place[0], body.measurements[0].place.y_m - place[1]) < 1e-6);
});

test("without enough light the answer has the reason", async () => {
  const { status, body } = await measure([{ receiver: "ball", turns: [turn(transmitters[0], [16, 9.9, 1.2])] }]);
  assert.equal(status, 200);
  assert.deepEqual([body.measurements[0].found, body.measurements[0].reason.code], [false, "too_few_transmitters"]);
});

test("what cannot be is refused with its field", async () => {
  const good = turn(transmitters[0], [16, 9.9, 1.2]);
  const refused = async (turns, hall) => {
    const { status, body } = await measure([{ receiver: "ball", turns }], hall);
    return [status, body.code, body.field];
  };
  assert.deepEqual(await refused([good], "nowhere"), [422, "unknown_hall", "/hall"]);
  assert.deepEqual(await refused([good, { ...good, transmitter: "tx-99" }]), [422, "unknown_transmitter", "/receivers/0/turns/1/transmitter"]);
  assert.deepEqual(await refused([good, good]), [422, "twice", "/receivers/0/turns/1/transmitter"]);
  assert.deepEqual(await refused([{ ...good, next_zero_s: good.zero_s }]), [422, "bad_pulses", "/receivers/0/turns/0"]);
  assert.deepEqual(await refused([{ ...good, first_s: 1e12 }]).then(([status, , field]) => [status, field]), [400, "/receivers/0/turns/0/first_s"]);
  assert.equal((await refused([]))[0], 400);
});
