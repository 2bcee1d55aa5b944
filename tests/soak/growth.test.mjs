// The soak's own judgement: it finds what grows and lets stand what does not.
import assert from "node:assert/strict";
import { test } from "node:test";
import { randomOf } from "../harness/random.mjs";
import { slope } from "./growth.mjs";

/** Twenty minutes of RSS in MB, every 5 s: a line, noise, and a snapshot each two minutes that stands out for half of one. */
function samples(mb_per_h, seed) {
  const random = randomOf(seed);
  return Array.from({ length: 240 }, (_, i) => ({ x: (5 * i) / 3600, y: 100 + (mb_per_h * 5 * i) / 3600 + 0.4 * (random() - 0.5) + (i % 24 < 6 ? 0.3 : 0) }));
}

test("what does not grow is let stand, what grows by more than its bound is found", () => {
  for (let seed = 1; seed <= 200; ++seed) {
    const flat = slope(samples(0, seed)), leak = slope(samples(4, seed));
    assert.ok(flat.value - 2 * flat.error <= 1, `seed ${seed}: ${JSON.stringify(flat)}`);
    assert.ok(leak.value - 2 * leak.error > 1, `seed ${seed}: ${JSON.stringify(leak)}`);
  }
});

test("a standstill that moved the level is no growth, and hides none", () => {
  const moved = (list) => list.map((p) => ({ ...p, y: p.x > 0.2 ? p.y + 0.6 : p.y }));
  for (let seed = 1; seed <= 200; ++seed) {
    assert.ok(slope(moved(samples(0, seed))).value > 1, "taken for growth without the break");
    const flat = slope(moved(samples(0, seed)), [0.2]), leak = slope(moved(samples(5, seed)), [0.2]);
    assert.ok(flat.value - 2 * flat.error <= 1, `seed ${seed}: ${JSON.stringify(flat)}`);
    assert.ok(leak.value - 2 * leak.error > 1, `seed ${seed}: ${JSON.stringify(leak)}`);
  }
});

test("a line without noise has its slope", () => {
  const { value, error } = slope(Array.from({ length: 40 }, (_, i) => ({ x: i, y: 3 - 2 * i })));
  assert.ok(Math.abs(value + 2) < 1e-9 && error < 1e-9);
});
