// The table of faults names the tests that hold them: each must exist where it says.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { ROOT } from "../harness/processes.mjs";

/** Whether a source holds the test: `Suite.Name` of GoogleTest, `Suite.*` for any of it, or a test's words. */
function holds(source, name) {
  const [, suite, which] = name.match(/^(?:\w+\/)?(\w+)\.(\w+|\*)$/) ?? [];
  if (suite) return new RegExp(`TEST(?:_F|_P)?\\(\\s*${suite},\\s*${which === "*" ? "\\w+" : `${which}\\)`}`).test(source);
  return source.includes(name);
}

test("every test that tests/faults/README.md names exists", () => {
  const rows = readFileSync(join(ROOT, "tests/faults/README.md"), "utf8").split("\n").filter((line) => line.startsWith("| ") && !line.startsWith("| What fell"));
  const missing = [];
  for (const row of rows) {
    const held = row.split(" | ").at(-1);
    let names = [], files = 0;
    for (const [, code, words] of held.matchAll(/`([^`]+)`|"([^"]+)"/g)) {
      if (words !== undefined || (!code.startsWith("tests/") && /^[\w/]+\.(\w+|\*)$/.test(code))) names.push(words ?? code);
      if (!code?.startsWith("tests/")) continue;
      ++files;
      const file = join(ROOT, code);
      const source = existsSync(file) ? (/\.\w+$/.test(code) ? readFileSync(file, "utf8") : " ") : undefined;
      if (source === undefined) missing.push(code);
      else missing.push(...names.filter((name) => !holds(source, name)).map((name) => `${name} in ${code}`));
      names = [];
    }
    if (files === 0 && !/seed \d+ of the fleet judge/.test(held)) missing.push(`a test for: ${row.slice(0, 80)}`);
  }
  assert.ok(rows.length > 60, `${rows.length} rows`);
  assert.deepEqual(missing, []);
});
