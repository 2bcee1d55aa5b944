// No test is lost: each belongs to a suite, and those that the tables of faults and of pretences name exist.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { test } from "node:test";

import { ROOT } from "../harness/processes.mjs";

/** Whether a source holds the test: `Suite.Name` of GoogleTest, `Suite.*` for any of it, or a test's words. */
function holds(source, name) {
  const [, suite, which] = name.match(/^(?:\w+\/)?(\w+)\.(\w+|\*)$/) ?? [];
  if (suite) return new RegExp(`TEST(?:_F|_P)?\\(\\s*${suite},\\s*${which === "*" ? "\\w+" : `${which}\\)`}`).test(source);
  return source.includes(name);
}

const isFile = (code) => code.startsWith("tests/") || code.startsWith("web/");

/** Rows of a document's tables of "What ..." whose last column names tests that are not there, or none; `open`: what a row may say instead. */
function missingIn(document, least, open) {
  const lines = readFileSync(join(ROOT, document), "utf8").split("\n");
  let inTable = false;
  const rows = lines.filter((line) => {
    if (!line.startsWith("|")) inTable = false;
    else if (line.startsWith("| What ")) inTable = true;
    else return inTable && line.startsWith("| ");
    return false;
  });
  const missing = [];
  for (const row of rows) {
    const held = row.split(" | ").at(-1);
    let names = [], files = 0;
    for (const [, code, words] of held.matchAll(/`([^`]+)`|"([^"]+)"/g)) {
      if (words !== undefined || (!isFile(code) && /^[\w/]+\.(\w+|\*)$/.test(code))) names.push(words ?? code);
      if (code === undefined || !isFile(code)) continue;
      ++files;
      const file = join(ROOT, code);
      const source = existsSync(file) ? (/\.\w+$/.test(code) ? readFileSync(file, "utf8") : " ") : undefined;
      if (source === undefined) missing.push(code);
      else missing.push(...names.filter((name) => !holds(source, name)).map((name) => `${name} in ${code}`));
      names = [];
    }
    if (files === 0 && !open.test(held)) missing.push(`a test for: ${row.slice(0, 80)}`);
  }
  assert.ok(rows.length > least, `${document}: ${rows.length} rows`);
  return missing;
}

test("every test that tests/faults/README.md names exists", () => assert.deepEqual(missingIn("tests/faults/README.md", 60, /seed \d+ of the fleet judge/), []));
test("every test that tests/experiments/README.md names exists", () => assert.deepEqual(missingIn("tests/experiments/README.md", 15, /^(later|as it is): .{10,}/), []));

test("every test that tests/e2e/README.md names exists", () => assert.deepEqual(missingIn("tests/e2e/README.md", 40, /^(later|as it is): .{10,}/), []));

const textOf = (file) => readFileSync(join(ROOT, file), "utf8");
const filesUnder = (folder, ending) => readdirSync(join(ROOT, folder), { recursive: true }).filter((name) => name.endsWith(ending)).map((name) => join(folder, name));

test("every test belongs to a suite", () => {
  const dev = textOf("dev"), cmake = textOf("CMakeLists.txt");
  const lost = [];
  const globs = new Set([...dev.matchAll(/(tests\/[a-z0-9_]+)\/\*\.test\.mjs/g)].map(([, folder]) => folder));
  for (const file of filesUnder("tests", ".test.mjs")) if (!globs.has(dirname(file))) lost.push(file);
  for (const file of filesUnder("tests", ".cpp")) {
    const fuzzed = file.match(/^tests\/fuzz\/(\w+)_fuzz\.cpp$/)?.[1];
    const isRun = fuzzed ? new RegExp(`/dev fuzz 60 .*\\b${fuzzed}\\b`).test(textOf("tests/nightly/run")) : cmake.includes(file);
    if (!isRun) lost.push(file);
  }
  // What the unit suite leaves out is run by name.
  const leftOut = dev.match(/case \$program in (\S+)\) continue/)[1].split("|").map((name) => basename(name));
  for (const name of leftOut) if (!dev.includes(`"$BUILD/${name}"`)) lost.push(name);
  for (const [, name] of cmake.matchAll(/^ +pulseline_test\((\w+)/gm)) if (!name.startsWith("test_")) lost.push(name);
  assert.ok(globs.size > 5 && leftOut.length > 3, "the script was read");
  assert.deepEqual(lost, []);
});

const tracked = execFileSync("git", ["ls-files"], { cwd: ROOT, encoding: "utf8" }).trim().split("\n").filter((file) => existsSync(join(ROOT, file)));
const folders = new Set(tracked.flatMap((file) => file.split("/").map((_, i, parts) => parts.slice(0, i).join("/"))));

test("every document that a source or a document names is in the repository", () => {
  const missing = tracked.filter((file) => /\.(md|[ch]pp|mjs|tsx?|css|sql|sh)$/.test(file) || file === "dev").flatMap((file) =>
    [...textOf(file).matchAll(/(?<![\w*.$}/-])([\w./-]*\w\.md)\b/g)].map(([, name]) => name)
      .filter((name) => ![name, join(dirname(file), name), join("core", name)].some((path) => tracked.includes(path)))
      .map((name) => `${name} in ${file}`));
  assert.deepEqual(missing, []);
});

test("every path that a document shows exists", () => {
  const missing = tracked.filter((file) => file.endsWith(".md")).flatMap((file) =>
    [...textOf(file).matchAll(/`((?:\.\.?\/|core|api|db|server|web|tests|docker)[\w./-]*\/[\w./*-]+)`/g)].map(([, name]) => name.replace(/\/$/, ""))
      .filter((name) => {
        const path = name.replace(/\*.*$/, "");
        return !folders.has(path) && !tracked.some((known) => known === path || known.startsWith(path));
      })
      .map((name) => `${name} in ${file}`));
  assert.deepEqual(missing, []);
});
