// One line of what the full load measured: the shift's own figures, then each attack's beside it. Takes the log of the part.
import { readFileSync } from "node:fs";

const found = [...readFileSync(process.argv[2], "utf8").matchAll(/^\s*# (\{.*\})$/gm)].map(([, text]) => JSON.parse(text));
const shift = found.find((f) => f.states_per_s !== undefined);
const attacks = found.filter((f) => f.health_p99_ms !== undefined);
const most = (of) => Math.max(...attacks.map(of));
const parts = [];
const memory = found.find((f) => f.in_memory)?.in_memory;
if (shift) parts.push(`to a dashboard p50 ${shift.state_to_dashboard.p50_ms} p99 ${shift.state_to_dashboard.p99_ms} ms, acceptance p99 ${shift.accepted.p99_ms} ms (${shift.machine_stood_still.n} standstills of the machine), RSS ${shift.rss_kb.warm} to ${shift.rss_kb.end} kB, ${shift.vehicles_lost} lost`);
if (memory) parts.push(`in memory acceptance p99 ${memory.accepted.p99_ms} ms`);
if (attacks.length > 0) parts.push(`${attacks.length} attacks: at most ${most((f) => f.to_dashboard.p99_ms)} ms to a dashboard, ${Math.round(most((f) => f.health_p99_ms))} ms health, ${most((f) => f.rss_kb)} kB`);
console.log(parts.join("; "));
