// One line of what the full load measured: the shift's own figures, then each attack's beside it. Takes the log of the part.
import { readFileSync } from "node:fs";

const found = [...readFileSync(process.argv[2], "utf8").matchAll(/^\s*# (\{.*\})$/gm)].map(([, text]) => JSON.parse(text));
const shift = found.find((f) => f.states_per_s !== undefined);
const attacks = found.filter((f) => f.health_p99_ms !== undefined);
const most = (of) => Math.max(...attacks.map(of));
const parts = [];
if (shift) parts.push(`to a dashboard p50 ${shift.state_to_dashboard.p50_ms} p99 ${shift.state_to_dashboard.p99_ms} ms, acceptance p99 ${shift.accepted.p99_ms} ms, RSS ${shift.rss_kb.warm} to ${shift.rss_kb.end} kB, ${shift.vehicles_lost} lost`);
if (attacks.length > 0) parts.push(`${attacks.length} attacks: at most ${most((f) => f.to_dashboard.p99_ms)} ms to a dashboard, ${Math.round(most((f) => f.health_p99_ms))} ms health, ${most((f) => f.rss_kb)} kB`);
console.log(parts.join("; "));
