// Writes api/openapi.json from api/openapi.yaml; with --check only says whether the two agree.
// The JSON is committed, so that building the server needs no Node.
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";

const here = new URL("./", import.meta.url);
const json = new URL("openapi.json", here);
const { parse } = createRequire(new URL("../web/package.json", here))("yaml");

const document = parse(readFileSync(new URL("openapi.yaml", here), "utf8"));
const text = `${JSON.stringify(document)}\n`;

if (process.argv.includes("--check")) {
    if (readFileSync(json, "utf8") !== text) {
        console.error("api/openapi.json is not what api/openapi.yaml says; run: node api/openapi_json.mjs");
        process.exit(1);
    }
} else {
    writeFileSync(json, text);
}
