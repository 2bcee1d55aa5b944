// A small client of the REST API, as a manufacturing execution system would write it.
import { until } from "./processes.mjs";

export class Client {
  constructor(url, token) {
    this.url = url;
    this.token = token;
  }

  async request(method, path, { body, headers = {}, raw } = {}) {
    const response = await fetch(this.url + path, {
      method,
      headers: { ...(this.token ? { Authorization: `Bearer ${this.token}` } : {}), ...(body !== undefined || raw !== undefined ? { "Content-Type": "application/json" } : {}), ...headers },
      body: raw ?? (body === undefined ? undefined : JSON.stringify(body)),
    });
    const text = await response.text();
    const type = response.headers.get("content-type") ?? "";
    return { status: response.status, headers: response.headers, type, body: type.includes("json") && text ? JSON.parse(text) : text };
  }

  async get(path) {
    const answer = await this.request("GET", path);
    if (answer.status !== 200) throw new Error(`GET ${path}: ${answer.status} ${JSON.stringify(answer.body)}`);
    return answer.body;
  }

  /** POST that must succeed. */
  async post(path, body, headers) {
    const answer = await this.request("POST", path, { body, headers });
    if (answer.status >= 300) throw new Error(`POST ${path}: ${answer.status} ${JSON.stringify(answer.body)}`);
    return answer.body;
  }

  order(vehicle, steps, headers) {
    return this.post("/api/v1/job-orders", { vehicle, steps: steps.map((s) => (typeof s === "number" ? { station: s } : s)) }, headers);
  }

  async untilOrder(id, condition, what, timeout_s = 60) {
    let last;
    return until(() => `order ${what}; last seen ${JSON.stringify(last)}`, async () => {
      last = await this.get(`/api/v1/job-orders/${id}`);
      return condition(last) && last;
    }, { timeout_s, every_ms: 50 });
  }
  untilEnded(id, timeout_s = 90) {
    return this.untilOrder(id, (o) => ["Ended", "Aborted"].includes(o.state), "ended", timeout_s);
  }

  untilVehicle(id, condition, what, timeout_s = 30) {
    let last;
    return until(() => `vehicle ${id} ${what}; last seen ${JSON.stringify(last)}`, async () => {
      last = await this.get(`/api/v1/vehicles/${id}`);
      return condition(last) && last;
    }, { timeout_s, every_ms: 50 });
  }
  untilReady(id, timeout_s = 30) {
    return this.untilVehicle(id, (v) => v.link === "live" && v.pose_known && v.reason?.code !== "vehicle_not_reported", "is live, has reported and knows its pose", timeout_s);
  }

  async stops(order) {
    return (await this.get(`/api/v1/stop-records?order=${order}&limit=100`)).items.reverse();
  }

  /** All events after a sequence number, read from the event stream until the newest is there. */
  async events(after = 0) {
    const { last_event_seq: last } = await this.get("/api/v1/fleet");
    const events = [];
    if (last <= after) return events;
    const stop = new AbortController();
    const response = await fetch(`${this.url}/api/v1/events?after=${after}`, { headers: { Authorization: `Bearer ${this.token}` }, signal: stop.signal });
    let text = "";
    const decoder = new TextDecoder();
    for await (const chunk of response.body) {
      text += decoder.decode(chunk, { stream: true });
      for (let end; (end = text.indexOf("\n\n")) >= 0; text = text.slice(end + 2)) {
        const data = text.slice(0, end).split("\n").filter((l) => l.startsWith("data:")).map((l) => l.slice(5)).join("\n");
        if (data) events.push(JSON.parse(data));
      }
      if ((events.at(-1)?.seq ?? 0) >= last) break;
    }
    stop.abort();
    return events;
  }
}

/** Difference of two angles in (-pi, pi]. */
export function angleBetween(a, b) {
  const d = a - b;
  return d - 2 * Math.PI * Math.round(d / (2 * Math.PI));
}
