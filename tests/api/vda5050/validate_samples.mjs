// Holds every sample message (DIR/TOPIC[.variant].json, written by test_vehicle_codec) against the
// official VDA 5050 schema of its topic. Usage: node validate_samples.mjs DIR
import { createRequire } from "node:module";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const root = join(dirname(fileURLToPath(import.meta.url)), "../../..");
const samples = process.argv[2] ?? join(root, "build/vda_samples");
const requireWeb = createRequire(join(root, "web/package.json"));
const Ajv = requireWeb("ajv/dist/2020").default;

const topics = ["order", "instantActions", "state", "visualization", "connection", "factsheet"];
const ajv = new Ajv({ strict: false, allErrors: true, validateFormats: true });
ajv.addFormat("date-time", /^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?Z$/);
const validators = new Map();
for (const topic of topics) {
  const schema = JSON.parse(readFileSync(join(root, `api/vda5050/schemas/${topic}.schema`), "utf8"));
  validators.set(topic, ajv.compile(schema));
}

if (!existsSync(samples)) {
  console.error(`${samples} is missing; run test_vehicle_codec first`);
  process.exit(2);
}
const files = readdirSync(samples).filter((name) => name.endsWith(".json"));
let failed = 0;
const seen = new Set();
for (const name of files) {
  const topic = name.split(".")[0];
  const validate = validators.get(topic);
  if (validate === undefined) {
    console.error(`${name}: no such topic`);
    failed += 1;
    continue;
  }
  seen.add(topic);
  const message = JSON.parse(readFileSync(join(samples, name), "utf8"));
  if (!validate(message)) {
    failed += 1;
    for (const e of validate.errors) console.error(`${name}: ${e.instancePath} ${e.message}`);
  }
  // A validator that accepts anything would prove nothing.
  const { timestamp, version, ...incomplete } = message;
  if (topic !== "visualization" && validate({ ...incomplete })) {
    failed += 1;
    console.error(`${name}: also valid without version`);
  }
}
for (const topic of topics.filter((t) => !seen.has(t))) {
  failed += 1;
  console.error(`no sample of topic ${topic}`);
}
console.log(`${files.length} VDA 5050 samples, ${failed} faults`);
process.exit(failed === 0 ? 0 : 1);
