import type { ModeOption } from "@/shared/api/types";
import { degrees as inDegrees, millimetres, number, wrap } from "@/shared/words/format";

export type Segment = NonNullable<ModeOption["segments"]>[number];
type Say = (key: string, params: Record<string, unknown>) => string;

/** Turns below this are corrections of the measured pose, the machine's business; they are named only when nothing else is. */
const kSmallTurn_rad = 0.5 * (Math.PI / 180);
const kMaxParts = 4;

/** What the wheels will do, as one short sentence: "turn 90.2° left, drive 10.003 m". */
export function moveWords(segments: readonly Segment[], say: Say, join: string): string {
  const all = joined(segments);
  const large = all.filter((s) => s.kind !== "rotate" || Math.abs(s.turn_rad) > kSmallTurn_rad);
  const shown = large.length > 0 ? large : all;
  if (shown.length > kMaxParts) {
    const length = segments.reduce((sum, s) => sum + Math.abs(s.length_m), 0);
    return say("words.many", { count: shown.length, length: number(length, { decimals: 1 }) });
  }
  return shown.map((s) => segmentWords(s, say)).join(join);
}

function goesOn(last: Segment, s: Segment): boolean {
  if (last.kind === "rotate" && s.kind === "rotate") return last.turn_rad * s.turn_rad > 0;
  if (last.kind !== s.kind || last.turn_rad * s.turn_rad <= 0 || last.length_m * s.length_m <= 0)
    return false;
  if (s.kind === "combined") return true;
  const from = last.centre ?? { x_m: 0, y_m: 0 };
  const to = s.centre ?? { x_m: 0, y_m: 0 };
  return s.kind === "arc" && Math.hypot(from.x_m - to.x_m, from.y_m - to.y_m) < 0.01;
}

/** Arcs and turns are cut for the vehicle's order; a person reads the pieces as one. */
export function joined(segments: readonly Segment[]): Segment[] {
  const out: Segment[] = [];
  for (const s of segments) {
    const last = out.at(-1);
    if (last && goesOn(last, s)) {
      out[out.length - 1] = {
        ...last,
        end: s.end,
        turn_rad: last.turn_rad + s.turn_rad,
        length_m: last.length_m + s.length_m,
        duration_s: last.duration_s + s.duration_s,
      };
    } else out.push(s);
  }
  return out;
}

export function segmentWords(s: Segment, say: Say): string {
  const degrees = (Math.abs(s.turn_rad) * 180) / Math.PI;
  // Never "0.0°": what is named is something.
  const angle = number(degrees, { decimals: degrees < 0.1 ? 3 : 1 });
  const side = s.turn_rad >= 0 ? "left" : "right";
  switch (s.kind) {
    case "rotate":
      return say(`words.turn_${side}`, { angle });
    case "straight":
      return straightWords(s, say);
    case "combined": {
      const length = number(Math.abs(s.length_m), { decimals: 3 });
      if (Math.abs(s.turn_rad) <= kSmallTurn_rad) return say("words.combined", { length });
      return say(`words.combined_${side}`, { angle, length });
    }
    case "arc": {
      const radius = Math.abs(s.turn_rad) > 1e-9 ? Math.abs(s.length_m / s.turn_rad) : 0;
      const back = s.length_m < 0 ? "back_" : "";
      return say(`words.arc_${back}${side}`, { angle, radius: number(radius, { decimals: 1 }) });
    }
  }
}

/** Within this of straight ahead, back or sideways nobody would name the angle. */
const kAsGoodAs_rad = 2 * (Math.PI / 180);

/** The direction alone says which way; without a sideways part the sign of the length may stand for it. */
function straightWords(s: Segment, say: Say): string {
  const length = number(Math.abs(s.length_m), { decimals: 3 });
  const left = wrap(s.direction_rad ?? 0);
  const off = Math.abs(left);
  const side = left > 0 ? "left" : "right";
  if (off < kAsGoodAs_rad) return say(`words.${s.length_m < 0 ? "back" : "drive"}`, { length });
  if (Math.PI - off < kAsGoodAs_rad) return say("words.back", { length });
  if (Math.abs(off - Math.PI / 2) < kAsGoodAs_rad) return say(`words.sideways_${side}`, { length });
  return say(`words.oblique_${side}`, { length, angle: number((off * 180) / Math.PI, { decimals: 1 }) });
}

/** What `mode.deviation` shows of an expected deviation, and how many of the vehicle's own arrivals say so. */
export function deviationValues(expected: NonNullable<ModeOption["expected_deviation"]>) {
  return {
    count: expected.arrivals,
    position: millimetres(expected.position_m, { decimals: expected.position_m < 0.01 ? 1 : 0 }),
    heading: inDegrees(expected.heading_rad, { decimals: 2 }),
  };
}

export function capitalise(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
