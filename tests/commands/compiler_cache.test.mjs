// What the compiler cache gives back is what would have been compiled, and nothing torn comes into it.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";

import { BUILD, ROOT, until } from "../harness/processes.mjs";

const folder = mkdtempSync(join(tmpdir(), "pulseline-ccache-"));
after(() => rmSync(folder, { recursive: true, force: true }));

function compiled(...args) {
  const done = spawnSync(join(BUILD, "ccache.sh"), ["g++", "-std=c++20", "-Winvalid-pch", "-MD", ...args], {
    cwd: folder, encoding: "utf8", env: { ...process.env, CCACHE_DIR: join(folder, "cache"), CCACHE_SLOPPINESS: "pch_defines,time_macros" },
  });
  return done.status === 0 ? "compiled" : done.stderr;
}

test("a header whose comment or spaces changed is precompiled anew", { skip: spawnSync("ccache", ["--version"]).status !== 0 && "no ccache" }, () => {
  writeFileSync(join(folder, "all.hpp"), '#include "part.hpp"\n');
  writeFileSync(join(folder, "all.cpp"), "");
  for (const part of ["int value = 0;  // of old", "int value = 0;  // the new", "int   value = 0;  // the new"]) {
    rmSync(join(folder, "all.hpp.gch"), { force: true });  // as in another clone
    writeFileSync(join(folder, "part.hpp"), `#pragma once\nstruct Part { ${part}\n};\n`);
    writeFileSync(join(folder, "main.cpp"), `#include "part.hpp"\nint main() { return Part{}.value + ${part.length}; }\n`);
    assert.equal(compiled("-x", "c++-header", "-include", join(folder, "all.hpp"), "-o", join(folder, "all.hpp.gch"), "-c", join(folder, "all.cpp")), "compiled");
    assert.equal(compiled("-include", join(folder, "all.hpp"), "-o", join(folder, "main.o"), "-c", join(folder, "main.cpp")), "compiled");
  }
});

test("a second build of a tree waits for the first", { timeout: 60_000 }, async () => {
  const tree = join(folder, "tree");
  mkdirSync(tree);
  writeFileSync(join(tree, "build.ninja"), "rule done\n  command = touch $out\nbuild pulseline: done\nbuild pulseline-agent: done\n");
  const first = spawn("flock", [join(tree, ".lock"), "sh", "-c", "echo holding; cat"]);  // until its input ends
  await new Promise((done) => first.stdout.once("data", done));
  const second = spawn(join(ROOT, "dev"), ["build"], { env: { ...process.env, PULSELINE_BUILD: tree } });
  const ended = new Promise((done) => second.on("exit", done));
  let said = "";
  for (const stream of [second.stdout, second.stderr]) stream.on("data", (text) => { said += text; });
  await until(() => `the second to wait; it said: ${said}`, () => said.includes("another build of this tree is under way"));
  assert.equal(existsSync(join(tree, "pulseline")), false);
  first.stdin.end();
  assert.equal(await ended, 0, said);
  assert.equal(existsSync(join(tree, "pulseline-agent")), true);
});
