// A plant for load: N small carriers in lanes of their own, each with a station at either end.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { ROOT } from "../harness/processes.mjs";

const LANE_M = 4, LENGTH_M = 12;

export function manyVehicles(count) {
  const base = JSON.parse(readFileSync(join(ROOT, "db/plants/pulse-line.json"), "utf8"));
  const columns = Math.ceil(count / 25), rows = Math.min(count, 25);
  const [hall] = base.halls;
  const box = (l, w) => [[-l / 2, -w / 2], [l / 2, -w / 2], [l / 2, w / 2], [-l / 2, w / 2]].map(([x_m, y_m]) => ({ x_m, y_m }));
  const width = columns * (LENGTH_M + 8) + 8, height = rows * LANE_M + 8;
  const camera = base.vehicle_types[0].cameras[0];
  const plant = {
    ...base, id: `load-${count}`, name: `Load, ${count} carriers`, areas: [], stations: [], markers: [], vehicles: [], loads: [], roadmap: { nodes: [], edges: [] },
    halls: [{ id: hall.id, name: hall.name, outline: [[0, 0], [width, 0], [width, height], [0, height]].map(([x_m, y_m]) => ({ x_m, y_m })) }],
    vehicle_types: [{ ...base.vehicle_types[0], id: "carrier", name: "Small carrier", footprint: box(2, 1), load_footprint: [], brackets: [], load_rules: undefined, parking: undefined, clearance_m: 0.3, max_speed_mps: 1, max_accel_mps2: 0.5, max_turn_rate_radps: 0.5, max_turn_accel_radps2: 0.5,
      wheels: base.vehicle_types[0].wheels.map((w) => ({ ...w, position: { x_m: Math.sign(w.position.x_m) * 0.8, y_m: Math.sign(w.position.y_m) * 0.4 } })),
      cameras: [["front", 0.7], ["back", -0.7]].map(([name, x_m]) => ({ ...camera, name, body_from_camera: { x_m, y_m: 0, heading_rad: 0 } })) }],
  };
  for (let i = 0; i < count; ++i) {
    const y = 6 + (i % rows) * LANE_M, x = 8 + Math.floor(i / rows) * (LENGTH_M + 8);
    for (const end of [0, 1]) {
      const number = 2 * i + end + 1, id = `st${number}`, at = x + end * LENGTH_M;
      for (const [side, off] of [["F", 0.7], ["B", -0.7]]) plant.markers.push({ id: `${id}${side}`, kind: "qr", payload: `ST${number}-${side}`, size_m: 0.06, hall: hall.id, pose: { x_m: at + off, y_m: y, heading_rad: 0 }, sigma_xy_m: 0.0001, sigma_heading_rad: 0.0005 });
      plant.stations.push({ id, number, name: `Lane ${i + 1}`, hall: hall.id, pose: { x_m: at, y_m: y, heading_rad: 0 }, tolerance: { shape: "box", dx_m: 0.025, dy_m: 0.025, dheading_rad: 0.0035 }, markers: [`${id}F`, `${id}B`], node: `n${number}`, resting_place: true, vehicle_types: [] });
      plant.roadmap.nodes.push({ id: `n${number}`, hall: hall.id, position: { x_m: at, y_m: y } });
    }
    plant.roadmap.edges.push({ id: `e${i}a`, from: `n${2 * i + 1}`, to: `n${2 * i + 2}` }, { id: `e${i}b`, from: `n${2 * i + 2}`, to: `n${2 * i + 1}` });
    // Lanes are joined at their first stations, so that every station can be reached.
    if (i > 0) plant.roadmap.edges.push({ id: `j${i}a`, from: `n${2 * i - 1}`, to: `n${2 * i + 1}` }, { id: `j${i}b`, from: `n${2 * i + 1}`, to: `n${2 * i - 1}` });
    plant.vehicles.push({ id: `V${i + 1}`, type: "carrier", manufacturer: "load", serial_number: `V${i + 1}`, name: `V${i + 1}`, home: `st${2 * i + 1}` });
  }
  return plant;
}
