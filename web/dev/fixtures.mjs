// A morning in final assembly, for pictures and for work on the screens without a server.
import { readFileSync } from "node:fs";

const plantFile = new URL("../../db/plants/final-assembly.json", import.meta.url);
const id = (n) => `01999999-0000-7000-8000-${String(n).padStart(12, "0")}`;

export function plant() {
  const p = JSON.parse(readFileSync(plantFile, "utf8"));
  return { ...p, id: p.id ?? "final-assembly", revision: p.revision ?? 14, markers: p.markers ?? [] };
}

const arc = (cx, cy, r, from, to, n = 24) =>
  Array.from({ length: n + 1 }, (_, i) => {
    const a = from + ((to - from) * i) / n;
    return { x_m: cx + r * Math.cos(a), y_m: cy + r * Math.sin(a) };
  });

function band(path, half) {
  const side = (sign) =>
    path.map((p, i) => {
      const a = path[Math.max(0, i - 1)];
      const b = path[Math.min(path.length - 1, i + 1)];
      const length = Math.hypot(b.x_m - a.x_m, b.y_m - a.y_m) || 1;
      return {
        x_m: p.x_m - (sign * half * (b.y_m - a.y_m)) / length,
        y_m: p.y_m + (sign * half * (b.x_m - a.x_m)) / length,
      };
    });
  return [...side(1), ...side(-1).reverse()];
}

export function snapshot(model, now = Date.now()) {
  const iso = (agoS) => new Date(now - agoS * 1000).toISOString();
  const number = new Map(model.stations.map((s) => [s.id, s.number]));
  const byNumber = new Map(model.stations.map((s) => [s.number, s]));
  const st = (n) => byNumber.get(n);
  const type = new Map(model.vehicle_types.map((t) => [t.id, t]));
  const made = new Map(model.vehicles.map((v) => [v.id, v]));
  const carriedBy = (id) => {
    const load = (model.loads ?? []).find((one) => one.vehicle === id);
    return load
      ? { load: load.id, load_kg: load.mass_kg, load_name: load.name }
      : { load_kg: 0, load_name: "" };
  };
  const vehicle = (name, over) => {
    const v = made.get(name);
    const t = type.get(v.type);
    return {
      id: v.id,
      name: v.name,
      type: v.type,
      link: "live",
      activity: "standing",
      last_heard_at: iso(0.2),
      pose_known: true,
      pose_at: iso(0.2),
      speed_mps: 0,
      hall: model.halls[0].id,
      at_station: "",
      paused: false,
      pause_confirmed: false,
      needs_resume: false,
      integration: "utilise",
      operating_mode: "AUTOMATIC",
      battery_percent: 81,
      e_stop: "NONE",
      field_violation: false,
      errors: [],
      brackets: t.brackets.map((b, i) => ({
        name: b.name,
        force_a_n: 27000 + 300 * i,
        force_b_n: 26500 - 200 * i,
        height_m: 0.12,
      })),
      wheels: t.wheels.map((w) => ({
        name: w.name,
        steering_rad: 0.05,
        speed_mps: 0,
        temperature_c: 31,
        fault: "",
      })),
      cameras: [],
      parking_feet: [],
      ...carriedBy(v.id),
      ...over,
    };
  };
  const standing = (n, over = {}) => ({ pose: st(n).pose, at_station: st(n).id, ...over });
  const feet = [1, 2, 3, 4].map((i) => ({ name: `P${i}`, extension_m: 0.12 }));
  const path = arc(40, 20, 10, Math.PI, 2 * Math.PI);
  const at = path[5];
  const leg = {
    id: id(901),
    station: st(4).id,
    mode: "fixed_axis_rotation",
    path,
    granted_points: 17,
    granted_area: [band(path.slice(0, 17), 5)],
    horizon_area: [band(path.slice(16), 5)],
    duration_s: 160,
    progress: 0.22,
    started_at: iso(35),
    expected_at: iso(-84),
  };
  const line = (points) => ({
    id: id(950 + points.length),
    station: st(28).id,
    mode: "lateral",
    path: points,
    granted_points: points.length,
    granted_area: [],
    horizon_area: [],
    duration_s: 40,
    progress: 0.2,
    started_at: iso(8),
    expected_at: iso(-22),
  });
  const omAt = { x_m: 66, y_m: 38 };
  const vehicles = [
    vehicle("TP-01", standing(6)),
    vehicle("TP-02", {
      activity: "moving",
      speed_mps: 0.32,
      pose: { ...at, heading_rad: -0.96 },
      order: id(1),
      leg,
    }),
    vehicle("TP-03", standing(1, { parking_feet: feet })),
    vehicle("MV-01", standing(14, { activity: "measuring" })),
    vehicle("MV-02", {
      link: "late",
      last_heard_at: iso(6.4),
      pose_at: iso(6.4),
      pose: { x_m: 22, y_m: 38, heading_rad: 0 },
      activity: "moving",
    }),
    vehicle("MV-03", {
      activity: "waiting",
      pose: { x_m: 72, y_m: 38, heading_rad: Math.PI },
      reason: { code: "floor_held", params: { vehicle: "OM-02" } },
    }),
    vehicle("OM-01", {
      activity: "moving",
      speed_mps: 0.4,
      pose: { x_m: 57.3, y_m: st(27).pose.y_m, heading_rad: 0 },
      order: id(3),
      leg: line([
        { x_m: 55, y_m: st(27).pose.y_m },
        { x_m: 63, y_m: st(27).pose.y_m },
      ]),
    }),
    vehicle("OM-02", {
      activity: "blocked",
      field_violation: true,
      pose: { ...omAt, heading_rad: Math.PI },
    }),
    vehicle("OM-03", standing(24)),
    vehicle(
      "DL-01",
      standing(34, { needs_resume: true, needs_resume_reason: { code: "server_restarted", params: {} } }),
    ),
    vehicle("DL-02", standing(38, { activity: "charging", battery_percent: 64 })),
    vehicle("DL-03", {
      activity: "waiting",
      pose: { x_m: 57.5, y_m: 11, heading_rad: Math.PI / 2 },
      reason: { code: "floor_held", params: { vehicle: "TP-02" } },
    }),
  ];
  const occupied = new Map(vehicles.filter((v) => v.at_station !== "").map((v) => [v.at_station, v.id]));
  const reserved = new Map(vehicles.filter((v) => v.leg !== undefined).map((v) => [v.leg.station, v.id]));
  const stations = model.stations.map((s) => ({
    station: s.id,
    number: s.number,
    occupied_by: occupied.get(s.id) ?? "",
    reserved_by: reserved.get(s.id) ?? "",
    ready: occupied.has(s.id),
  }));
  const order = (n, name, steps, over) => ({
    id: id(n),
    number: n,
    name: `JO-${n}`,
    state: "AllowedToStart",
    priority: 0,
    steps: steps.map(([s, state]) => ({ station: st(s).id, number: s, motion_mode: "auto", state })),
    current_step: Math.max(
      0,
      steps.findIndex(([, state]) => state !== "done"),
    ),
    vehicle: name,
    wanted_vehicle: name,
    cancel_requested: false,
    pause_requested: false,
    created_by: "panel-2",
    created_at: iso(600 - n),
    revision: 1,
    ...over,
  });
  const first = order(
    1,
    "TP-02",
    [
      [3, "done"],
      [4, "driving"],
    ],
    { state: "Running", expected_at: iso(-84) },
  );
  first.steps[1].leg = leg.id;
  const jobOrders = [
    first,
    order(2, "TP-01", [[7, "pending"]], {
      reason: { code: "paused_by_person", params: { actor: "panel-2" } },
      state: "Interrupted",
    }),
    order(3, "OM-01", [[28, "driving"]], { state: "Running", expected_at: iso(-22) }),
    order(4, "MV-03", [[24, "driving"]], {
      state: "Running",
      reason: { code: "floor_held", params: { vehicle: "OM-02" } },
    }),
    order(
      5,
      "",
      [
        [19, "pending"],
        [20, "pending"],
      ],
      { reason: { code: "no_free_vehicle", params: {} } },
    ),
  ];
  const stop = (n, s, over) => ({
    id: id(500 + n),
    order: id(1),
    leg: id(700 + n),
    step: 0,
    vehicle: "TP-02",
    station: st(s).id,
    number: s,
    mode: "linear",
    theoretical: st(s).pose,
    measured: st(s).pose,
    dx_m: 0.0031,
    dy_m: -0.0042,
    dheading_rad: 0.0007,
    along_m: 0.0031,
    left_m: -0.0042,
    sigma_xy_m: 0.0004,
    sigma_heading_rad: 0.0001,
    tolerance: st(s).tolerance,
    inside: true,
    attempt: 1,
    method: "dual_camera",
    markers: [],
    load_kg: 21500,
    at: iso(200 + 60 * n),
    ...over,
  });
  return {
    type: "snapshot",
    server_time: new Date(now).toISOString(),
    fleet: {
      paused: false,
      last_event_seq: 812,
      vehicles_live: 11,
      vehicles_total: 12,
      needs_resume: vehicles.filter((v) => v.needs_resume).map((v) => v.id),
      plant_revision: model.revision,
      server_started_at: iso(9000),
    },
    vehicles,
    stations,
    job_orders: jobOrders,
    stop_records: [stop(1, 3, {}), stop(2, 2, { mode: "fixed_axis_rotation" })],
    number: Object.fromEntries(number),
  };
}

export function poses(vehicles, tick) {
  return {
    type: "poses",
    at: new Date().toISOString(),
    poses: vehicles
      .filter((v) => v.link === "live" && v.pose)
      .map((v) => [
        v.id,
        v.pose.x_m + 0.02 * Math.sin(tick / 9),
        v.pose.y_m,
        v.pose.heading_rad,
        v.speed_mps,
        0.1,
      ]),
  };
}

export const session = {
  name: "panel-2",
  role: "operator",
  csrf_token: "mock",
  expires_at: "2099-01-01T00:00:00Z",
};
