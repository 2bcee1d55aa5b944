// Lays codes on the lanes of a plant: one in the middle of each lane's pieces of at most `spacing` metres, so that cameras pass over them in both
// directions; on a lane that has codes, as many more as keep two of them no farther apart than that. Usage: node tests/tools/lane_codes.mjs FILE [KIND [FIRST_NUMBER [SPACING_M]]]
import { readFileSync, writeFileSync } from "node:fs";

const SHORTEST_M = 4; // a shorter lane has the codes of its neighbours
const BESIDE_M = 0.04; // within a camera's view
const APART_M = 2;
const SIZE_M = { qr: 0.06, apriltag: 0.05, landmark: 0.08 };

/** The markers to add to the plant file `plant`. */
export function laneCodes(plant, { kind = "apriltag", first = 300, spacing_m = 9 } = {}) {
  const nodes = new Map(plant.roadmap.nodes.map((node) => [node.id, node]));
  const codes = plant.markers.map((marker) => ({ hall: marker.hall, ...marker.pose }));
  const laid = [], seen = new Set();
  for (const { from, to } of plant.roadmap.edges) {
    const name = [from, to].sort().join(" ");
    if (seen.has(name)) continue;
    seen.add(name);
    const [a, b] = [nodes.get(from), nodes.get(to)];
    const [dx, dy] = [b.position.x_m - a.position.x_m, b.position.y_m - a.position.y_m];
    const length = Math.hypot(dx, dy);
    const along = ({ x_m, y_m }) => ((x_m - a.position.x_m) * dx + (y_m - a.position.y_m) * dy) / length;
    const beside = ({ x_m, y_m }) => Math.abs((x_m - a.position.x_m) * dy - (y_m - a.position.y_m) * dx) / length;
    const there = codes.filter((code) => code.hall === a.hall && beside(code) <= BESIDE_M && along(code) >= 0 && along(code) <= length).map(along);
    if (length < SHORTEST_M) continue;
    for (const share of there.length === 0 ? middles(length, spacing_m) : between(there, length, spacing_m)) {
      const at = { x_m: round(a.position.x_m + share * dx), y_m: round(a.position.y_m + share * dy), heading_rad: Math.atan2(dy, dx) };
      if (codes.some((code) => code.hall === a.hall && Math.hypot(code.x_m - at.x_m, code.y_m - at.y_m) < APART_M)) continue;
      codes.push({ hall: a.hall, ...at });
      const number = first + laid.length;
      const payload = kind === "qr" ? `LANE-${number}` : String(number);
      laid.push({ id: `lane-${number}`, kind, payload, size_m: SIZE_M[kind], hall: a.hall, pose: at, sigma_xy_m: 0.0001, sigma_heading_rad: 0.0005 });
    }
  }
  return laid;
}

/** Shares of the lane: the middles of its pieces. */
function middles(length, spacing_m) {
  const pieces = Math.ceil(length / spacing_m);
  return Array.from({ length: pieces }, (_, i) => (i + 0.5) / pieces);
}

/** Shares of the lane between the codes on it, and half as far from its ends, which other lanes go on from. */
function between(there, length, spacing_m) {
  const stops = [-spacing_m / 2, ...there.toSorted((a, b) => a - b), length + spacing_m / 2];
  return stops.slice(1).flatMap((to, i) => {
    const pieces = Math.ceil((to - stops[i]) / spacing_m - 1e-9);
    return Array.from({ length: pieces - 1 }, (_, k) => (stops[i] + ((k + 1) * (to - stops[i])) / pieces) / length);
  });
}

function round(metres) {
  return Math.round(metres * 1000) / 1000;
}

if (process.argv[1] === import.meta.filename) {
  const [file, kind, first, spacing] = process.argv.slice(2);
  const text = readFileSync(file, "utf8");
  const laid = laneCodes(JSON.parse(text), { kind, first: first && Number(first), spacing_m: spacing && Number(spacing) });
  const end = text.indexOf("\n  ]", text.search(/^ {2}"markers": \[/m));
  const lines = laid.map((marker) => `    ${JSON.stringify(marker).replace(/":/g, '": ').replace(/,"/g, ', "')}`);
  if (lines.length) writeFileSync(file, `${text.slice(0, end)},\n${lines.join(",\n")}${text.slice(end)}`);
  console.log(`${lines.length} codes on lanes of ${file}`);
}
