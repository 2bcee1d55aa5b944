// Each verb of ./dev installs every command it calls, and the first command of the README works where nothing else is.
import assert from "node:assert/strict";
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, realpathSync, rmSync, statSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, delimiter, join } from "node:path";
import { test } from "node:test";

import { BUILD, ROOT, freePort, until } from "../harness/processes.mjs";

const run = (command, args) => execFileSync(command, args, { encoding: "utf8", maxBuffer: 1 << 26 });

/** docker/packages by section: package -> the command whose lack asks for it ("" when always installed). */
function sections() {
  const found = new Map();
  let section;
  for (const line of readFileSync(join(ROOT, "docker/packages"), "utf8").split("\n")) {
    if (line === "" || line.startsWith("#")) continue;
    const head = line.match(/^\[(.+)\]$/);
    if (head) found.set(head[1], (section = new Map()));
    else if (line.includes(":")) section.set(line.split(": ")[1], line.split(":")[0]);
    else section.set(line, "");
  }
  return found;
}

/** Packages that every Debian has, debootstrap's minbase with them. */
function requiredPackages() {
  const rows = run("dpkg-query", ["-W", "-f", "${Package} ${Priority} ${Essential}\n"]).trim().split("\n").map((row) => row.split(" "));
  return new Set(rows.filter(([, priority, essential]) => priority === "required" || essential === "yes").map(([name]) => name));
}

function pathOf(command) {
  for (const folder of process.env.PATH.split(delimiter)) {
    const file = join(folder, command);
    if (existsSync(file) && statSync(file).isFile() && statSync(file).mode & 0o111) return file;
  }
}

const owners = new Map();
/** The Debian package of a command on this machine; "" for one that came another way. */
function ownerOf(command) {
  if (!owners.has(command)) {
    const file = pathOf(command);
    // Files are listed under the name they had before /bin became /usr/bin.
    const names = file ? [...new Set([file, realpathSync(file)].flatMap((name) => [name, name.replace(/^\/usr\//, "/"), name.replace(/^\/(s?bin)\//, "/usr/$1/")]))] : [];
    const owned = names.map((name) => spawnSync("dpkg", ["-S", name], { encoding: "utf8" })).find((found) => found.status === 0);
    const line = owned?.stdout.split("\n").find((row) => !row.startsWith("diversion "));
    owners.set(command, line ? line.split(":")[0].split(",")[0] : "");
  }
  return owners.get(command);
}

/** The functions of a script by name, "" for what stands outside them; without comments and texts printed as they are. */
function functionsOf(script) {
  const found = new Map([["", ""]]);
  let name = "";
  let end;
  for (const raw of readFileSync(script, "utf8").split("\n")) {
    if (end) { if (raw === end) end = undefined; continue; }
    const line = raw.replace(/(^|\s)#.*$/, "");
    end = line.match(/<<'?([A-Z]+)'?/)?.[1];
    const head = line.match(/^([a-z_]+)\(\) *[({]/);
    if (head) found.set((name = head[1]), "");
    found.set(name, `${found.get(name)}\n${head ? line.slice(head[0].length) : line}`);
    if (/^[)}]/.test(line) || (head && /[)}]\s*$/.test(line))) name = "";
  }
  return found;
}

const kBuiltins = new Set(run("bash", ["-c", "compgen -b -k"]).split("\n"));

/** Words that stand where a shell looks for a command. */
function commands(text) {
  const before = String.raw`(?:(?:then|do|else|if|elif|until|while|exec|env|nice|as_root|xargs|!|suite \w+|[A-Za-z_]+=\S*)\s+)*`;
  const place = new RegExp(String.raw`(?:^|[;&|({\`'"])\s*${before}([a-z][A-Za-z0-9_.+-]*)(?=[\s;)]|$)`, "gm");
  return new Set([...text.matchAll(place)].map(([, word]) => word).filter((word) => !kBuiltins.has(word)));
}

/** What a piece of the script reaches: itself and the functions it calls. */
function reached(functions, text) {
  const seen = new Set();
  const all = [];
  const walk = (piece) => {
    all.push(piece);
    for (const word of commands(piece)) if (functions.has(word) && !seen.has(word)) { seen.add(word); walk(functions.get(word)); }
  };
  walk(text);
  return all.join("\n");
}

const kScripts = { fresh: "docker/fresh", nightly: "tests/nightly/run" };

/** What each verb of ./dev does, as text, and the sections of docker/packages that it installs. */
function verbs() {
  const functions = functionsOf(join(ROOT, "dev"));
  const table = functions.get("").slice(functions.get("").lastIndexOf("case ${1:-} in"));
  return [...table.matchAll(/^([a-z]+)\)(.*);;$/gm)].map(([, verb, what]) => {
    const script = kScripts[verb] ? functionsOf(join(ROOT, kScripts[verb])) : new Map();
    const text = [reached(functions, what), ...script.values()].join("\n");
    const calls = [...commands(text)].filter((word) => !functions.has(word) && !script.has(word));
    return { verb, calls, installs: [...text.matchAll(/install_packages ([a-z ]+)/g)].flatMap((found) => found[1].trim().split(" ")) };
  });
}

test("every verb installs the commands that it calls", () => {
  const required = requiredPackages();
  const listed = sections();
  const lacking = [];
  for (const { verb, calls, installs } of verbs()) {
    const packages = new Map(installs.flatMap((name) => [...listed.get(name)]));
    for (const word of calls) {
      if (!pathOf(word) || required.has(ownerOf(word)) || packages.has(ownerOf(word))) continue;
      if ([...packages.values()].includes(word)) continue;
      lacking.push(`${verb}: ${word} (${ownerOf(word) || "of no package"})`);
    }
  }
  assert.deepEqual(lacking, [], "name them in a section of docker/packages that the verb installs");
});

test("every command that a test starts is installed by ./dev test", () => {
  const required = requiredPackages();
  const listed = new Map([...sections().get("build"), ...sections().get("test")]);
  const lacking = [];
  for (const file of readdirSync(join(ROOT, "tests"), { recursive: true }).filter((name) => name.endsWith(".mjs"))) {
    for (const [, command] of readFileSync(join(ROOT, "tests", file), "utf8").matchAll(/\b(?:spawn|execFile|exec)(?:Sync)?\("([^" ]+)/g)) {
      if (required.has(ownerOf(command)) || listed.has(ownerOf(command)) || [...listed.values()].includes(basename(command))) continue;
      lacking.push(`${file}: ${command}`);
    }
  }
  assert.deepEqual(lacking, []);
});

test("./dev run needs the build packages and nothing else", () => {
  assert.deepEqual([...new Set(verbs().find(({ verb }) => verb === "run").installs)], ["build"]);
});

/** A folder with the commands of a bare Debian 12 and of the packages that ./dev run installs, and no others. */
function bareCommands(folder) {
  mkdirSync(folder);
  const build = sections().get("build");
  const link = (name, file) => { if (file && !existsSync(join(folder, name))) symlinkSync(file, join(folder, name)); };
  const installed = [...requiredPackages(), ...build.keys()].filter((name) => spawnSync("dpkg", ["-s", name], { stdio: "ignore" }).status === 0);
  for (const file of run("dpkg", ["-L", ...installed]).split("\n")) {
    if (/^(\/usr)?\/s?bin\/[^/]+$/.test(file) && existsSync(file)) link(basename(file), file);
  }
  for (const name of ["awk", ...build.values()].filter((name) => name)) link(name, pathOf(name));
  return folder;
}

test("./dev run serves the page and its vehicles on a bare machine", { timeout: 120_000 }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "pulseline-bare-"));
  const port = await freePort();
  const env = { PATH: bareCommands(join(folder, "bin")), HOME: folder, PULSELINE_BUILD: BUILD, PULSELINE_DEMO: join(folder, "demo"), PULSELINE_LISTEN: `127.0.0.1:${port}`, JOBS: "2" };
  const demo = spawn(join(ROOT, "dev"), ["run", "pulse-line"], { env, cwd: folder, detached: true });
  let said = "";
  for (const stream of [demo.stdout, demo.stderr]) stream.on("data", (text) => { said += text; });
  const over = new Promise((done) => demo.on("exit", done));
  try {
    await until(() => `the demo's greeting; it said:\n${said.slice(-2000)}`, () => {
      assert.ok(demo.exitCode === null, `./dev run ended:\n${said.slice(-2000)}`);
      return said.includes("Pulseline runs at");
    }, { timeout_s: 90 });
    assert.doesNotMatch(said, /not found/);
    assert.match(await (await fetch(`http://127.0.0.1:${port}/`)).text(), /<div id="root"/);
    const [name, password] = readFileSync(join(folder, "demo/pulse-line/users"), "utf8").split("\n")[0].trim().split(/ +/);
    assert.match(password, /^[A-Za-z0-9]{16}$/);
    const origin = `http://127.0.0.1:${port}`;
    const signedIn = await fetch(`${origin}/api/v1/session`, { method: "POST", headers: { "content-type": "application/json", origin, "sec-fetch-site": "same-origin" }, body: JSON.stringify({ name, password }) });
    assert.equal(signedIn.status, 200, await signedIn.text());
    const cookie = signedIn.headers.get("set-cookie").split(";")[0];
    await until("the vehicle's connection", async () => (await (await fetch(`${origin}/api/v1/vehicles/TP-01`, { headers: { cookie } })).json()).link === "live");
  } finally {
    if (demo.exitCode === null) process.kill(-demo.pid, "SIGINT");  // what it ended with is told above
    await over;
    rmSync(folder, { recursive: true, force: true });
  }
});

test("both programs are built as what is attacked from outside: addresses at random, no table that can be written, checked copies", () => {
  for (const name of ["pulseline", "pulseline-agent"]) {
    const read = (...flags) => execFileSync("readelf", ["-W", ...flags, join(BUILD, name)], { encoding: "utf8", maxBuffer: 1 << 28 });
    assert.match(read("-h"), /Type:\s+DYN/, `${name}: position independent`);
    assert.match(read("-l"), /GNU_RELRO/, name);
    assert.match(read("-d"), /BIND_NOW|Flags:.*NOW/, name);
    const calls = read("--dyn-syms");
    assert.match(calls, /__stack_chk_fail/, name);
    assert.match(calls, /__mem(cpy|move|set)_chk/, `${name}: _FORTIFY_SOURCE`);
  }
});
