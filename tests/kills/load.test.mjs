// kill -9 of the server under load: at random moments and at every named place of core/base/crash_points.def.
//   PULSELINE_KILLS  random kills (40)    PULSELINE_KILL_ROUNDS  passes over all places (1)
//   PULSELINE_KILL_SEED (1)               PULSELINE_KILL_HALLS   servers side by side (4)
// A failure prints its seed; the choices repeat with it, the interleaving of the machine does not.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { BUILD, Plant, ROOT, System } from "../harness/processes.mjs";
import { randomOf } from "../harness/random.mjs";
import { LoadHall } from "./load_hall.mjs";

const number = (name, otherwise) => Number(process.env[name] ?? otherwise);
const KILLS = number("PULSELINE_KILLS", 40), ROUNDS = number("PULSELINE_KILL_ROUNDS", 1);
const SEED = number("PULSELINE_KILL_SEED", 1), HALLS = number("PULSELINE_KILL_HALLS", 4);

const NAMES = [...readFileSync(join(ROOT, "core/base/crash_points.def"), "utf8").matchAll(/^CRASH_POINT\(\w+, "(\w+)"\)$/gm)].map((m) => m[1]);
const MIGRATION = "start_in_migration";  // passed only where a database is new

function plans() {
  const random = randomOf(SEED);
  const all = [];
  for (let i = 0; i < KILLS; ++i) all.push({ after_ms: Math.floor(20 + 1500 * random() ** 2) });
  for (let round = 0; round < ROUNDS; ++round) {
    for (const point of NAMES) {
      if (point === MIGRATION) continue;
      const stop = point.startsWith("stop_");
      const once = stop || point.startsWith("start_") || point.startsWith("snapshot_") || point.startsWith("checkpoint_");
      all.push({ point, stop, passage: once ? 1 : 1 + Math.floor(20 * random()), after_ms: Math.floor(800 * random()) });
    }
  }
  // Mixed by the seed, so that every hall meets both kinds.
  for (let i = all.length - 1; i > 0; --i) {
    const j = Math.floor(random() * (i + 1));
    [all[i], all[j]] = [all[j], all[i]];
  }
  return all;
}

test(`the server killed under load, seed ${SEED}`, async (t) => {
  const waiting = plans();
  const planned = waiting.length;
  const total = { kills: 0 };
  assert.ok(NAMES.length >= 25, "the list of crash points was read");
  // Each is waited for, when one fails too: a hall whose server is taken from it in the middle of a death waits for ever.
  const halls = await Promise.allSettled(Array.from({ length: HALLS }, async (_, i) => {
    const hall = await LoadHall.begin(`hall${i}`, SEED * 100 + i);
    t.after(() => hall.system.stop());
    for (let plan; (plan = waiting.shift());) {
      if (waiting.length % 100 === 0 && planned > 100) console.error(`${planned - waiting.length} of ${planned} kills`);
      try {
        await hall.die(plan);
      } catch (error) {
        waiting.length = 0;
        error.message = `seed ${SEED}, ${hall.name}, ${JSON.stringify(plan)}: ${error.message}\nkept in ${hall.system.directory}`;
        throw error;
      }
    }
    await hall.finish();
    for (const [name, count] of Object.entries(hall.counts)) total[name] = (total[name] ?? 0) + count;
  }));
  for (const { reason } of halls) if (reason) throw reason;
  t.diagnostic(`${total.kills} kills, ${NAMES.length - 1} named places: ${JSON.stringify(total)}`);
  assert.equal(total.kills, KILLS + ROUNDS * (NAMES.length - 1));
  assert.ok(total.created >= total.kills, "there was load");
  assert.ok(total.weighed >= total.kills, "people said what loads weigh");
  assert.ok(total.replayed >= 10 * total.kills, "the journals held what happened");
  assert.ok(total.given_up <= 0.02 * total.created, `${total.given_up} orders of vehicles that did not see their codes`);
});

test("the server killed while it makes a new database", async (t) => {
  const system = new System(new Plant("pulse-line"), mkdtempSync(join(tmpdir(), "pulseline-test-")));
  t.after(() => system.stop());
  const first = ["serve", "--db", system.database, "--plant", system.plant.file, "--listen", "127.0.0.1:0"];
  // Each migration is a transaction: a life gets as far as its passage, the next one goes on from there.
  for (const passage of [1, 2]) {
    const dying = system.start(join(BUILD, "pulseline"), first, "server", { PULSELINE_CRASH_AT: `${MIGRATION}:${passage}` });
    assert.equal((await dying.ended).signal, "SIGKILL");
  }
  system.cli(["plant", "import", system.plant.file]);
  const { faults } = JSON.parse(execFileSync(join(BUILD, "stored"), ["check", system.database], { encoding: "utf8" }));
  assert.deepEqual(faults, []);
});
