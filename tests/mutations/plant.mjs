// Plants bugs: node plant.mjs LIST.txt ROOT OUT copies each source that the list changes from ROOT to OUT with all of its bugs
// in it, and writes OUT/planted.hpp with their names. It fails when a change fits nowhere or at two places.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

/** The bugs and the changes of a list: [{name, seed, what}], [{source, at, lines: ["-...", "+...", " ..."]}]. */
export function readList(text) {
  const bugs = [], changes = [];
  let source, change;
  text.split("\n").forEach((line, i) => {
    const bug = line.match(/^bug k(\w+)(?: \((?:seed (\d+)|unit tests)\))?: (.+)$/);
    if (bug) bugs.push({ name: bug[1], seed: Number(bug[2] ?? 0), what: bug[3] });
    else if (line.startsWith("== ")) source = line.slice(3);
    else if (line === "") change = undefined;
    else if (/^[-+ ]/.test(line) && source) {
      if (!change) changes.push(change = { source, at: i + 1, lines: [] });
      change.lines.push(line);
    } else if (!line.startsWith("#")) throw new Error(`line ${i + 1}: neither a bug, nor a source, nor a change: ${line}`);
  });
  for (const { name } of bugs) {
    if (!changes.some(({ lines }) => lines.some((line) => line.includes(`Mutation::k${name})`)))) throw new Error(`no change plants k${name}`);
  }
  return { bugs, changes };
}

/** The lines of a source with one change in them. */
export function plant(lines, { source, at, lines: change }) {
  const old = change.filter((line) => line[0] !== "+").map((line) => line.slice(1).trim());
  const places = lines.flatMap((_, i) => (old.every((line, k) => lines[i + k]?.trim() === line) ? [i] : []));
  if (places.length !== 1) {
    throw new Error(`line ${at}: ${places.length === 0 ? "no longer fits" : `fits ${places.length} times`} in ${source}: ${old.join(" / ")}`);
  }
  const changed = change.filter((line) => line[0] !== "-").map((line) => line.slice(1));
  return [...lines.slice(0, places[0]), ...changed, ...lines.slice(places[0] + old.length)];
}

/** The copies with all bugs in them, by source. */
export function plantAll({ changes }, read) {
  const copies = new Map();
  for (const change of changes) {
    copies.set(change.source, plant(copies.get(change.source) ?? read(change.source).split("\n"), change));
  }
  return copies;
}

const inWords = (name) => name.replace(/(?<!^)[A-Z]/g, (letter) => ` ${letter}`).toLowerCase();

/** What mutated sources and the program that switches their bugs on include. */
const header = (area, list, bugs) => `// Made by tests/mutations/plant.mjs of ${list}.
#pragma once
#include <cstdint>

namespace pulseline::${area} {

enum class Mutation {
    kNone,
${bugs.map(({ name, what }) => `    k${name},  // ${what}\n`).join("")}};

struct Planted {
    const char* name;
    std::uint64_t found_by;  // a seed that finds it; 0: none is known
};
inline constexpr Planted kPlanted[] = {{"none", 0},
${bugs.map(({ name, seed }) => `                                       {"${inWords(name)}", ${seed}},\n`).join("")}};

inline Mutation planted_mutation = Mutation::kNone;
inline bool mutated(Mutation mutation) { return planted_mutation == mutation; }

}  // namespace pulseline::${area}
`;

function main(listFile, root, out) {
  const area = basename(listFile, ".txt");
  const list = readList(readFileSync(listFile, "utf8"));
  const put = (file, text) => {
    mkdirSync(dirname(join(out, file)), { recursive: true });
    writeFileSync(join(out, file), text);
  };
  for (const [source, lines] of plantAll(list, (file) => readFileSync(join(root, file), "utf8"))) {
    put(source, `#include "planted.hpp"\n#line 1 "${source}"\n${lines.join("\n")}`);
  }
  put("planted.hpp", header(area, `tests/mutations/${area}.txt`, list.bugs));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  try {
    main(...process.argv.slice(2, 5));
  } catch (error) {
    console.error(`${process.argv[2]}: ${error.message}`);
    process.exit(1);
  }
}
