import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { describe, expect, it } from "vitest";

const src = fileURLToPath(new URL("../..", import.meta.url));

function catalogFiles(dir: string): string[] {
  return readdirSync(dir, { withFileTypes: true, recursive: true })
    .filter((entry) => entry.isFile() && entry.name.endsWith(".en.json"))
    .map((entry) => `${entry.parentPath}/${entry.name}`);
}

function flat(value: unknown, prefix = ""): Map<string, string> {
  const all = new Map<string, string>();
  for (const [key, item] of Object.entries(value as Record<string, unknown>)) {
    if (typeof item === "string") all.set(prefix + key, item);
    else for (const [k, v] of flat(item, `${prefix}${key}.`)) all.set(k, v);
  }
  return all;
}

const read = (file: string) => flat(JSON.parse(readFileSync(file, "utf8")));
/** English has a singular that Chinese lacks. */
const withoutPlural = (keys: Iterable<string>) =>
  new Set([...keys].map((k) => k.replace(/_(one|other)$/, "")));
const holes = (text: string) => new Set([...text.matchAll(/\{\{\s*(\w+)/g)].map((m) => m[1]));

/** Keys that stand twice in one object: reading takes the later one without a word. */
function twice(json: string): string[] {
  const found: string[] = [];
  const open: Set<string>[] = [];
  for (const [token, key] of json.matchAll(/"((?:[^"\\]|\\.)*)"\s*:|"(?:[^"\\]|\\.)*"|[{}]/g)) {
    if (token === "{") open.push(new Set());
    else if (token === "}") open.pop();
    else if (key !== undefined) {
      if (open.at(-1)?.has(key)) found.push(key);
      open.at(-1)?.add(key);
    }
  }
  return found;
}

const files = catalogFiles(src);

describe.each(files)("%s", (file) => {
  const en = read(file);
  const zh = read(file.replace(".en.json", ".zh.json"));

  it("has no key twice", () => {
    for (const name of [file, file.replace(".en.json", ".zh.json")])
      expect([name, twice(readFileSync(name, "utf8"))]).toEqual([name, []]);
  });
  it("has the same keys in both languages", () => {
    expect([...withoutPlural(zh.keys())].sort()).toEqual([...withoutPlural(en.keys())].sort());
  });
  it("names the same values in both languages", () => {
    for (const [key, text] of en) {
      const other = zh.get(key);
      if (other !== undefined && !/_(one|other)$/.test(key))
        expect([key, holes(other)]).toEqual([key, holes(text)]);
    }
  });
  it("leaves nothing empty", () => {
    for (const [key, text] of [...en, ...zh]) expect([key, text.trim()]).not.toEqual([key, ""]);
  });
});

describe("codes of the core", () => {
  const core = fileURLToPath(new URL("../../../../core", import.meta.url));
  const kTold = [
    /\b(?:because|blocked|refuse|stop_for)\(\s*\{?"([a-z_]+)"/g,
    /\bfail\(\s*Errc::\w+,\s*"([a-z_]+)"/g,
    /\bReason\{\s*"([a-z_]+)"/g,
    /\{\s*"([a-z_]+)",\s*\{[{}]/g, // a code with its parameters, wherever it is made
    /constexpr const char\* k\w+ = "([a-z_]+)"/g, // those of reason_codes.hpp, which have one name
    /\b(?:try_again|abort_order|require_person|set_order_reason|interrupt)\([^;{]*\{"([a-z_]+)"/g,
  ];
  // What a vehicle tells of itself, what a plan says, what a stop could not be measured for.
  const kFolders = [
    "fleet",
    "planning",
    "kinematics",
    "localisation",
    "control",
    "onboard",
    "simulation",
    "traffic",
    "vision",
  ];
  // Said on the command line and in logs only, or of a file that nobody sees in the browser.
  const kNotForScreens = new Set([
    "no_home_station",
    "too_few_resting_places",
    "unreachable",
    "traffic_record_broken",
    "journal_broken",
  ]);
  const codes = new Set<string>();
  const files = kFolders.flatMap((folder) =>
    readdirSync(`${core}/${folder}`, { recursive: true, encoding: "utf8" })
      .filter((name) => /\.cpp$|reason_codes\.hpp$/.test(name))
      .map((name) => `${folder}/${name}`),
  );
  // Of the plant only what bars a vehicle with a load: the rest is said of files.
  for (const file of [...files, "plant/load_rules.cpp", "plant/carrying.cpp"]) {
    const text = readFileSync(`${core}/${file}`, "utf8");
    for (const told of kTold) for (const match of text.matchAll(told)) codes.add(match[1]!);
  }
  const known = read(`${src}shared/words/catalogs/reasons.en.json`);

  it("are found in the source", () => expect(codes.size).toBeGreaterThan(140));
  it.each([...codes].filter((code) => !kNotForScreens.has(code)))("%s has words", (code) =>
    expect(known.has(code)).toBe(true),
  );
});
