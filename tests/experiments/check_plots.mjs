// check_plots.mjs FOLDER: what `experiments navigation` and `experiments igps` have drawn there is whole: one curve of errors over
// distance for each family and method, and a map of the cell with a colour for each place.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";

const [folder] = process.argv.slice(2);
const METHODS = {
  "transport-platform": ["odometry", "codes"],
  "omni-mover": ["odometry", "codes", "iGPS"],
  "measuring-vehicle": ["reflectors"],
  "delivery-vehicle": ["odometry", "codes", "contours"],
};

const navigation = readFileSync(join(folder, "navigation.svg"), "utf8");
const curves = [...navigation.matchAll(/<polyline points="([^"]*)"[^>]*><title>([^<]*)<\/title>/g)].map(([, points, name]) => ({
  name, heights: points.trim().split(" ").map((point) => Number(point.split(",")[1])),
}));
const wanted = Object.entries(METHODS).flatMap(([family, methods]) => methods.map((method) => `${family}, ${method}`));
assert.deepEqual(curves.map(({ name }) => name), wanted, "one curve for each family and method");
for (const { name, heights } of curves) {
  assert.ok(heights.length >= 19 && heights.every(Number.isFinite), `${name}: a point every 10 m of 200`);
  assert.ok(new Set(heights).size > 5, `${name}: errors differ along the way`);
}
// An SVG file's y points down: the error of wheels alone is the curve that ends highest.
const end = (name) => curves.find((curve) => curve.name === name).heights.at(-1);
assert.ok(end("omni-mover, odometry") < end("omni-mover, codes") && end("omni-mover, codes") < end("omni-mover, iGPS"));

const igps = readFileSync(join(folder, "igps.svg"), "utf8");
const cell = /<g id="cell">([^]*?)<\/g>/.exec(igps)?.[1] ?? "";
const places = [...cell.matchAll(/<rect x="(\d+)" y="(\d+)"[^>]* fill="([^"]+)"/g)];
assert.equal(new Set(places.map(([, x, y]) => `${x},${y}`)).size, places.length, "no place twice");
assert.ok(places.length > 2000, "a colour every half metre of the cell");
assert.ok(new Set(places.map(([, , , fill]) => fill)).size > 20, "accuracy differs over the cell");
assert.ok(places.some(([, , , fill]) => fill === "#b91c1c"), "below a head too few receivers see light");
console.log(`${curves.length} curves, ${places.length} places`);
