// What the pages of the vehicles and of the stops show, laid over the morning of fixtures.mjs. Figures of stations 1 to 7 are Tang's.
export const kOrder = "01999999-0000-7000-8000-00000000aaaa";
const uuid = (n) => `01999999-0000-7000-8001-${String(n).padStart(12, "0")}`;
const rad = Math.PI / 180;
const kDev = [
  [6, -2.76, -0.24, 0.099, "fixed_axis_rotation"],
  [5, 5.14, 6.32, -0.142, "fixed_axis_rotation"],
  [4, -4.27, -4.99, 0.056, "fixed_axis_rotation"],
  [3, 3.53, 8.11, 0.006, "linear"],
  [2, -5.87, -8.89, -0.132, "linear"],
  [1, 51.23, 31.36, -1.38, "linear"],
];
let counter = 0;

export function stopFor(model, vehicle, number, dx_m, dy_m, deg, agoS, over = {}) {
  const station = model.stations.find((s) => s.number === number);
  const p = station.pose;
  const tol = station.tolerance;
  const dh = deg * rad;
  const c = Math.cos(p.heading_rad);
  const s = Math.sin(p.heading_rad);
  return {
    id: uuid(1000 + counter++),
    order: uuid(1),
    leg: uuid(2),
    step: 0,
    vehicle,
    station: station.id,
    number,
    mode: "linear",
    theoretical: p,
    measured: { x_m: p.x_m + dx_m, y_m: p.y_m + dy_m, heading_rad: p.heading_rad + dh },
    dx_m,
    dy_m,
    dheading_rad: dh,
    along_m: c * dx_m + s * dy_m,
    left_m: -s * dx_m + c * dy_m,
    sigma_xy_m: 0.0003,
    sigma_heading_rad: 0.00005,
    tolerance: tol,
    inside: Math.abs(dx_m) <= tol.dx_m && Math.abs(dy_m) <= tol.dy_m && Math.abs(dh) <= tol.dheading_rad,
    attempt: 1,
    method: "dual_camera",
    markers: [`ST0${number}-F`, `ST0${number}-B`],
    load_kg: 22000,
    at: new Date(Date.now() - agoS * 1000).toISOString(),
    ...over,
  };
}

export function enrich(snapshot, model) {
  counter = 0;
  const first = structuredClone(snapshot);
  const tp = first.vehicles.find((v) => v.id === "TP-01");
  const kn = {
    "front left": [25.8, 25.3],
    "front right": [25.2, 25.6],
    "back left": [28.9, 28.3],
    "back right": [28.0, 28.6],
  };
  tp.brackets = tp.brackets.map((b) => ({
    name: b.name,
    force_a_n: kn[b.name][0] * 1000,
    force_b_n: kn[b.name][1] * 1000,
    height_m: 0.1204,
  }));
  const steer = { FL: 79.5, FR: -79.5, BL: -79.5, BR: 79.5, "drive front": 90, "drive back": 90 };
  tp.wheels = tp.wheels.map((w) => ({
    ...w,
    steering_rad: (steer[w.name] ?? 90) * rad,
    temperature_c: w.name === "BR" ? 71 : 34,
  }));
  tp.parking_feet = ["front left", "front right", "back left", "back right"].map((name) => ({
    name,
    extension_m: 0.0003,
    force_n: 0,
  }));
  tp.load_centre = { x_m: -0.62, y_m: 0.004 };
  tp.cameras = [
    ["front", 0.00275, -0.009, "ST06-F"],
    ["back", 0.00277, 0.00947, "ST06-B"],
  ].map(([name, f, l, payload]) => ({
    name,
    found: true,
    payload,
    code: { x_m: 0, y_m: 0 },
    forward_m: f,
    left_m: l,
    angle_rad: 0,
    sigma_m: 0.0001,
    rms_px: 0.21,
    why_not: "",
    image_at: tp.pose_at,
  }));
  tp.reason = { code: "no_order", params: {} };
  tp.pose = { x_m: 84.99724, y_m: 19.99976, heading_rad: 0.099 * rad };
  const stops = kDev.map(([n, dx, dy, deg, mode], i) =>
    stopFor(model, "TP-01", n, dx / 1000, dy / 1000, deg, 600 + 5000 * i, { mode }),
  );
  let seed = 7;
  const noise = () => ((seed = (seed * 1103515245 + 12345) % 2147483648) / 2147483648) * 2 - 1;
  for (let i = 0; i < 24; ++i) {
    stops.push(
      stopFor(
        model,
        "TP-01",
        1 + (i % 7),
        0.0065 * noise(),
        0.0065 * noise(),
        0.13 * noise(),
        40000 + 5000 * i,
        { order: uuid(3) },
      ),
    );
  }
  first.stop_records = [...stops, ...first.stop_records.filter((s) => s.vehicle !== "TP-01")];
  return first;
}

export function orderFor() {
  return {
    id: kOrder,
    number: 2417,
    name: "JO-2417",
    state: "AllowedToStart",
    priority: 0,
    steps: [{ station: "st07", number: 7, motion_mode: "linear", state: "pending" }],
    current_step: 0,
    vehicle: "TP-01",
    wanted_vehicle: "TP-01",
    cancel_requested: false,
    pause_requested: false,
    created_by: "panel-2",
    created_at: new Date().toISOString(),
    revision: 1,
    expected_at: new Date(Date.now() + 91000).toISOString(),
  };
}

const kSwept =
  "76.95 39.39 76.99 39.21 77.16 39.05 77.31 36.88 81.3 36.85 81.69 35.01 92.65 34.95 93.35 35.41 93.72 34.72 94.32 34.52 94.95 32 95.84 32 97.49 32.35 98.78 32.9 100.06 33.75 101.16 34.83 102.1 36.22 102.69 37.65 103 39.16 103 40.05 100.48 40.68 100.28 41.28 99.59 41.45 100.03 42.21 100.02 43.31 98.83 44.63 97.22 45.58 97.18 46 98.11 46.83 98.13 47.68 96.58 48.15 94.85 48.3 92.99 48.05 91.23 47.39 89.78 46.45 88.48 45.13 81.76 45.05 81.31 43.18 77.35 43.16 77.2 41.05";

export function dryRun(model, first, body) {
  const station = model.stations.find((s) => s.number === body.steps[0].station);
  const start = { x_m: 84.99724, y_m: 19.99976, heading_rad: 0.099 * rad };
  const pose = station.pose;
  const n = kSwept.split(" ").map(Number);
  const swept = [];
  for (let i = 0; i + 1 < n.length; i += 2) swept.push({ x_m: n[i], y_m: 60 - n[i + 1] });
  const turned = { ...start, heading_rad: 0 };
  const there = { x_m: pose.x_m, y_m: pose.y_m, heading_rad: 0 };
  const common = { route: [], turns: 2, cost: 120, nearest: "TP-03" };
  const options = [
    {
      mode: "self_rotation",
      feasible: false,
      suggested: false,
      reason: { code: "not_in_place", params: { distance_m: 10.0028 } },
    },
    {
      ...common,
      mode: "linear",
      feasible: true,
      suggested: true,
      length_m: 10.0028,
      duration_s: 91,
      clearance_m: 2.25,
      swept_area_m2: 264,
      swept: [swept],
      segments: [
        { kind: "rotate", start, end: turned, turn_rad: -0.1 * rad, length_m: 0, duration_s: 2 },
        {
          kind: "straight",
          start: turned,
          end: there,
          turn_rad: 0,
          length_m: 10.0028,
          direction_rad: 0,
          duration_s: 50,
        },
        { kind: "rotate", start: there, end: pose, turn_rad: Math.PI / 2, length_m: 0, duration_s: 39 },
      ],
    },
    {
      ...common,
      mode: "free",
      feasible: true,
      suggested: false,
      length_m: 31.2,
      duration_s: 125,
      clearance_m: 1.4,
      swept_area_m2: 380,
      swept: [swept],
      segments: [
        {
          kind: "arc",
          start,
          end: pose,
          turn_rad: 2.4,
          length_m: 31.2,
          centre: { x_m: 90, y_m: 28 },
          duration_s: 125,
        },
      ],
    },
    {
      mode: "fixed_axis_rotation",
      feasible: false,
      suggested: false,
      reason: { code: "target_on_heading_line", params: { offset_m: 0.017, radius_m: 2900, limit_m: 200 } },
    },
    {
      mode: "lateral",
      feasible: false,
      suggested: false,
      reason: { code: "not_beside", params: { along_m: 10.0028 } },
    },
  ];
  const age_s = 0.2;
  const checks = [
    { code: "link", result: "pass", params: { link: "live", silent_s: 0.2 }, age_s },
    {
      code: "pose",
      result: "pass",
      params: {
        station: 6,
        dx_m: -0.00276,
        dy_m: -0.00024,
        dheading_rad: 0.099 * rad,
        x_m: 84.997,
        y_m: 20,
        heading_rad: 0.0017,
      },
      age_s,
    },
    {
      code: "load",
      result: "pass",
      params: { total_n: 215700, unbalance: 0.06, limit: 0.1, max_load_kg: 24000 },
      age_s,
    },
    { code: "parking_feet", result: "pass", params: { furthest_m: 0.0003, feet: 4 }, age_s },
    {
      code: "codes_in_view",
      result: "pass",
      params: { front: "ST06-F", back: "ST06-B", found: 2, cameras: 2 },
      age_s,
    },
    { code: "station", result: "pass", params: { station: station.number } },
    { code: "clearance", result: "pass", params: { clearance_m: 2.25, limit_m: 0.5, nearest: "TP-03" } },
    { code: "wheels", result: "note", params: { wheels: 6, wheel: "BR", temperature_c: 71 }, age_s },
    { code: "battery", result: "pass", params: { percent: 81, limit_percent: 20 }, age_s },
    { code: "safety", result: "pass", params: { e_stop: "NONE", field_violation: false }, age_s },
    { code: "mode", result: "pass", params: { operating_mode: "AUTOMATIC" }, age_s },
  ];
  return {
    vehicle: body.vehicle,
    accepted: true,
    checks,
    steps: [
      {
        station: station.id,
        number: station.number,
        start,
        chosen: "linear",
        options,
        alternatives: [],
        expected_deviation: {
          stops: 28,
          mean_m: 0.0044,
          max_m: 0.009,
          mean_rad: 0.085 * rad,
          max_rad: 0.147 * rad,
        },
      },
    ],
  };
}
