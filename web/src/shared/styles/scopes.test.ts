import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { expect, it } from "vitest";

// A page's styles come when it is opened, and stay: a selector that another page's elements fit changes that page from
// then on. So each selector of a feature names a class that nobody else styles. stale.css only lists what it hatches.
const root = fileURLToPath(new URL("../../", import.meta.url));
const sheets = readdirSync(root, { recursive: true, encoding: "utf8" })
  .filter((file) => file.endsWith(".css") && !file.endsWith("stale.css"))
  .map((file) => ({ file, owner: /^features\/([^/]+)/.exec(file)?.[1] ?? "shared", text: read(file) }));

function read(file: string): string {
  return readFileSync(root + file, "utf8").replace(/\/\*[^]*?\*\//g, "");
}

function selectorsOf(text: string): string[] {
  const heads = [...text.matchAll(/([^{};]+)\{/g)].map(([, head]) => head!.trim());
  return heads
    .filter((head) => head !== "" && !/^(@|from$|to$|\d)/.test(head))
    .flatMap((head) => head.split(/,(?![^(]*\))/).map((one) => one.trim()));
}
const classesOf = (selector: string) => [...selector.matchAll(/\.([a-z][\w-]*)/gi)].map(([, name]) => name!);

const owners = new Map<string, Set<string>>();
for (const { owner, text } of sheets) {
  for (const name of selectorsOf(text).flatMap(classesOf))
    owners.set(name, (owners.get(name) ?? new Set()).add(owner));
}

it("lets no feature style the pages of another", () => {
  const own = (name: string, owner: string) => owners.get(name)?.size === 1 && owners.get(name)?.has(owner);
  const leaks = sheets
    .filter(({ owner }) => owner !== "shared")
    .flatMap(({ file, owner, text }) =>
      selectorsOf(text)
        .filter((selector) => !classesOf(selector).some((name) => own(name, owner)))
        .map((selector) => `${file}: ${selector}`),
    );
  expect(sheets.length).toBeGreaterThan(40);
  expect(leaks).toEqual([]);
});
