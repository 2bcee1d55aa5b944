// What one client alone can do to a server, each for as long as it is told. Every attacker is bounded in sockets and time, talks to the
// server under test only, and ends what it began. `end` is the moment to stop at, in ms since 1970.
import { Agent, request } from "node:http";
import { connect } from "node:net";

const alive = (end) => Date.now() < end;
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/** One request over its own agent's connections; resolves to the status, 0 when the connection ended first. */
function ask(system, method, path, { body, headers = {}, agent } = {}) {
  return new Promise((done) => {
    const asked = request(system.url + path, { method, agent, headers: { ...(body ? { "Content-Type": "application/json", "Content-Length": Buffer.byteLength(body) } : {}), ...headers } }, (response) => {
      response.resume().on("end", () => done(response.statusCode)).on("error", () => done(0));
    });
    asked.setTimeout(30_000, () => asked.destroy());
    asked.on("error", () => done(0));
    asked.end(body);
  });
}

/** `count` askers, each asking again as soon as it has its answer. */
async function crowd(count, end, act) {
  const agent = new Agent({ keepAlive: true, maxSockets: count });
  await Promise.all(Array.from({ length: count }, async (_, i) => { for (let n = 0; alive(end); ++n) if ((await act(agent, i, n)) === 0) await pause(50); }));
  agent.destroy();
}

/** `count` raw connections; `talk(socket, i)` says something each `every_ms`. Those that the server cuts are begun again. */
async function connections(system, count, end, every_ms, talk) {
  const open = () => {
    const socket = connect(system.port, system.host).on("error", () => {});
    socket.opened = false;
    return socket;
  };
  const sockets = Array.from({ length: count }, open);
  while (alive(end)) {
    sockets.forEach((socket, i) => {
      if (socket.destroyed) sockets[i] = open();
      else talk(socket, i);
    });
    await pause(every_ms);
  }
  for (const socket of sockets) socket.destroy();
}

const bearer = (system) => ({ Authorization: `Bearer ${system.attackerToken}` });
const once = (socket, text) => { if (!socket.opened) { socket.opened = true; socket.write(text); } };

export const attacks = {
  "sign-ins with invented names": (system, end) => crowd(24, end, (agent, i, n) =>
    ask(system, "POST", "/api/v1/session", { agent, headers: { Origin: system.url, "Sec-Fetch-Site": "same-origin" }, body: JSON.stringify({ name: `nobody-${i}-${n}`, password: "a-wrong-password" }) })),

  "dry runs of a hundred steps": (system, end) => {
    const [vehicle] = system.plant.model.vehicles;
    const body = JSON.stringify({ vehicle: vehicle.id, steps: Array.from({ length: 100 }, (_, i) => ({ station: 1 + (i % 2) })) });
    return crowd(7, end, (agent) => ask(system, "POST", "/api/v1/job-orders?dryRun=true", { agent, headers: bearer(system), body }));
  },

  "stations read by one program": (system, end) => crowd(40, end, (agent, i, n) => ask(system, "GET", `/api/v1/stations/${1 + ((i * 31 + n) % system.plant.model.stations.length)}`, { agent, headers: bearer(system) })),

  "large bodies of strangers": (system, end) => {
    const body = JSON.stringify({ text: "x".repeat(250_000) });
    return crowd(60, end, (agent) => ask(system, "POST", "/api/v1/job-orders", { agent, body }));
  },

  "headers that never end": (system, end) => connections(system, 200, end, 500, (socket) => {
    once(socket, "GET /api/v1/fleet HTTP/1.1\r\nHost: x\r\n");
    socket.write("X-A: b\r\n");
  }),

  "bodies that never end": (system, end) => connections(system, 200, end, 500, (socket) => {
    once(socket, `POST /api/v1/job-orders HTTP/1.1\r\nHost: x\r\nAuthorization: Bearer ${system.attackerToken}\r\nContent-Type: application/json\r\nContent-Length: 200000\r\n\r\n`);
    socket.write(" ");
  }),

  "readers that never read": (system, end) => connections(system, 60, end, 500, (socket) => {
    once(socket, `GET /api/v1/stream HTTP/1.1\r\nHost: x\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==\r\nAuthorization: Bearer ${system.attackerToken}\r\n\r\n`);
    socket.pause();
  }),

  "marker sheets printed by one program": (system, end) => crowd(20, end, (agent) => ask(system, "GET", `/api/v1/marker-sheets?stations=${Array.from({ length: 100 }, (_, n) => n + 1).join(",")}`, { agent, headers: bearer(system) })),

  "dashboards that come and go": (system, end) => connections(system, 40, end, 400, (socket) => {
    if (socket.opened) return socket.destroy();
    once(socket, `GET /api/v1/stream HTTP/1.1\r\nHost: x\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==\r\nAuthorization: Bearer ${system.attackerToken}\r\n\r\n`);
  }),

  "one vehicle whose error changes a hundred times a second": async (system, end) => {
    const { manufacturer, serial_number, id, home } = system.plant.model.vehicles.at(-1);
    const station = system.plant.model.stations.find((s) => s.id === home);
    const open = () => {
      const socket = new WebSocket(`ws://${system.host}:${system.port}/vehicles/${manufacturer}/${serial_number}`, { protocols: ["vda5050.v2.json"], headers: { Authorization: `Bearer ${system.tokenOfVehicle(id)}` } });
      socket.onerror = () => {};
      return socket;
    };
    const state = (n) => JSON.stringify({ topic: "state", retain: false, payload: {
      headerId: n, timestamp: new Date().toISOString(), version: "2.1.0", manufacturer, serialNumber: serial_number, orderId: "", orderUpdateId: 0, lastNodeId: station.node, lastNodeSequenceId: 0, driving: false,
      operatingMode: "AUTOMATIC", nodeStates: [], edgeStates: [], actionStates: [], batteryState: { batteryCharge: 80, charging: false }, safetyState: { eStop: "NONE", fieldViolation: false },
      errors: [{ errorType: "wheel", errorLevel: "WARNING", errorDescription: `temperature ${n}` }],
      agvPosition: { x: station.pose.x_m, y: station.pose.y_m, theta: 0, mapId: station.hall, positionInitialized: true },
    } });
    let socket = open();
    for (let n = 1; alive(end); ++n) {
      if (socket.readyState === 1) socket.send(state(n));
      else if (socket.readyState === 3) socket = open();
      await pause(10);
    }
    socket.close();
  },
};
