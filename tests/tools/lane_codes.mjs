// Lays codes on the lanes of a plant file: AprilTags in the middle of each lane's pieces of at most SPACING metres, so that cameras pass over them
// in both directions. Lanes that have a code stay as they are. Usage: node tests/tools/lane_codes.mjs FILE [FIRST_PAYLOAD [SPACING_M]]
import { readFileSync, writeFileSync } from "node:fs";

const [file, first = "300", spacing = "9"] = process.argv.slice(2);
const SHORTEST_M = 4; // a shorter lane has the codes of its neighbours
const BESIDE_M = 0.04; // within a camera's view
const APART_M = 0.5;

const text = readFileSync(file, "utf8");
const plant = JSON.parse(text);
const nodes = new Map(plant.roadmap.nodes.map((node) => [node.id, node]));
const codes = plant.markers.map((marker) => ({ hall: marker.hall, ...marker.pose }));
const lines = [];
let payload = Number(first);
const seen = new Set();

for (const { from, to } of plant.roadmap.edges) {
  const name = [from, to].sort().join(" ");
  if (seen.has(name)) continue;
  seen.add(name);
  const [a, b] = [nodes.get(from), nodes.get(to)];
  const [dx, dy] = [b.position.x_m - a.position.x_m, b.position.y_m - a.position.y_m];
  const length = Math.hypot(dx, dy);
  const along = ({ x_m, y_m }) => ((x_m - a.position.x_m) * dx + (y_m - a.position.y_m) * dy) / length;
  const beside = ({ x_m, y_m }) => Math.abs((x_m - a.position.x_m) * dy - (y_m - a.position.y_m) * dx) / length;
  const has = codes.some((code) => code.hall === a.hall && beside(code) <= BESIDE_M && along(code) >= 0 && along(code) <= length);
  if (length < SHORTEST_M || has) continue;
  const pieces = Math.ceil(length / Number(spacing));
  for (let i = 0; i < pieces; i++) {
    const share = (i + 0.5) / pieces;
    const at = { x_m: round(a.position.x_m + share * dx), y_m: round(a.position.y_m + share * dy), heading_rad: Math.atan2(dy, dx) };
    if (codes.some((code) => code.hall === a.hall && Math.hypot(code.x_m - at.x_m, code.y_m - at.y_m) < APART_M)) continue;
    codes.push({ hall: a.hall, ...at });
    lines.push(
      `    {"id": "lane-${payload}", "kind": "apriltag", "payload": "${payload}", "size_m": 0.05, "hall": "${a.hall}", "pose": {"x_m": ${at.x_m}, "y_m": ${at.y_m}, ` +
        `"heading_rad": ${at.heading_rad}}, "sigma_xy_m": 0.0001, "sigma_heading_rad": 0.0005}`,
    );
    payload++;
  }
}

function round(metres) {
  return Math.round(metres * 1000) / 1000;
}

const end = text.indexOf("\n  ]", text.search(/^ {2}"markers": \[/m));
writeFileSync(file, lines.length ? `${text.slice(0, end)},\n${lines.join(",\n")}${text.slice(end)}` : text);
console.log(`${lines.length} codes on lanes of ${file}`);
