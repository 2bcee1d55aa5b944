// Planted bugs live in tests/mutations only, and each still fits the source that it is planted in.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { ROOT } from "../harness/processes.mjs";
import { plantAll, readList } from "../mutations/plant.mjs";

const read = (file) => readFileSync(join(ROOT, file), "utf8");
const lists = ["traffic", "fleet"].map((area) => readList(read(`tests/mutations/${area}.txt`)));

test("every planted bug fits its source at one place", () => {
  for (const list of lists) {
    const copies = plantAll(list, read);
    const planted = [...copies.values()].flat().join("\n");
    for (const { name } of list.bugs) assert.ok(planted.includes(`mutated(Mutation::k${name})`), name);
  }
});

test("a line that is gone, or stands there twice, is named with its list's line", () => {
  const [{ changes }] = lists;
  const change = changes.find(({ source }) => source === "core/traffic/grants.cpp");
  const line = change.lines.find((l) => l[0] === "-").slice(1);
  const without = (file) => read(file).replace(line, line.replace("plan.halted", "plan.is_halted"));
  assert.throws(() => plantAll({ changes: [change] }, without), new RegExp(`line ${change.at}: no longer fits in core/traffic/grants.cpp`));
  const twice = (file) => read(file).replace(line, `${line}\n${line}`);
  assert.throws(() => plantAll({ changes: [change] }, twice), /fits 2 times in core\/traffic\/grants.cpp/);
});

test("a bug without a change, and a line that is none of these, are refused", () => {
  assert.throws(() => readList("bug kNothing: it is planted nowhere\n"), /no change plants kNothing/);
  assert.throws(() => readList("== core/a.cpp\nreturn;\n"), /line 2: neither a bug/);
});

test("the product's sources know no planted bug", () => {
  const sources = ["core", "api", "server", "db"].flatMap((folder) =>
    readdirSync(join(ROOT, folder), { recursive: true }).filter((name) => /\.[ch]pp$/.test(name)).map((name) => join(folder, name)));
  assert.ok(sources.length > 500);
  assert.deepEqual(sources.filter((file) => /\bmutated\(|Mutation::|planted\.hpp/.test(read(file))), []);
});
