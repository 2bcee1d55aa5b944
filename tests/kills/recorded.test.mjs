// A database that an older program has written: what it stored is what this program makes of the same inputs, to the last byte.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { gunzipSync } from "node:zlib";
import { BUILD } from "../harness/processes.mjs";

// Recorded on 2026-11-30, after feet stay where they are with a weight that nobody knows. A change that is meant to change
// what the fleet does, or the form of a snapshot, needs a new recording of the program before it: tests/tools/record_journal.mjs.
test("a recorded journal is replayed to the same snapshots and events", () => {
  const file = join(mkdtempSync(join(tmpdir(), "pulseline-recorded-")), "p.db");
  writeFileSync(file, gunzipSync(readFileSync(join(import.meta.dirname, "recorded/journal.db.gz"))));
  const found = JSON.parse(execFileSync(join(BUILD, "pulseline"), ["journal", "verify", "--db", file, "--json"], { encoding: "utf8" }));
  assert.deepEqual(found.passed_over, []);
  assert.equal(found.difference, null);
  assert.ok(found.inputs > 2500 && found.events > 900, JSON.stringify(found));
});
