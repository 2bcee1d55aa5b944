import type { ModeOption } from "@/shared/api/types";
import { number } from "@/shared/words/format";

export type Segment = NonNullable<ModeOption["segments"]>[number];
type Say = (key: string, params: Record<string, unknown>) => string;

/** Turns below this are corrections of the measured pose; they are named only when nothing else is. */
const kSmallTurn_rad = 0.02 * (Math.PI / 180);
const kMaxParts = 4;

/** What the wheels will do, as one short sentence: "turn 0.1° left, drive 10.003 m". */
export function moveWords(segments: readonly Segment[], say: Say, join: string): string {
  const shown = joined(segments).filter((s) => s.kind !== "rotate" || Math.abs(s.turn_rad) > kSmallTurn_rad);
  if (shown.length > kMaxParts) {
    const length = segments.reduce((sum, s) => sum + Math.abs(s.length_m), 0);
    return say("words.many", { count: shown.length, length: number(length, { decimals: 1 }) });
  }
  return shown.map((s) => segmentWords(s, say)).join(join);
}

/** An arc is cut below 180 degrees for the vehicle's order; a person reads the pieces as one. */
function joined(segments: readonly Segment[]): Segment[] {
  const out: Segment[] = [];
  for (const s of segments) {
    const last = out.at(-1);
    const goesOn =
      last?.kind === "arc" &&
      s.kind === "arc" &&
      last.turn_rad * s.turn_rad > 0 &&
      last.length_m * s.length_m > 0 &&
      Math.hypot(
        (last.centre?.x_m ?? 0) - (s.centre?.x_m ?? 0),
        (last.centre?.y_m ?? 0) - (s.centre?.y_m ?? 0),
      ) < 0.01;
    if (last && goesOn) {
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
  const angle = number((Math.abs(s.turn_rad) * 180) / Math.PI, { decimals: 1 });
  const side = s.turn_rad >= 0 ? "left" : "right";
  switch (s.kind) {
    case "rotate":
      return say(`words.turn_${side}`, { angle });
    case "straight":
      return say(`words.${straightKey(s)}`, { length: number(Math.abs(s.length_m), { decimals: 3 }) });
    case "arc": {
      const radius = Math.abs(s.turn_rad) > 1e-9 ? Math.abs(s.length_m / s.turn_rad) : 0;
      const back = s.length_m < 0 ? "back_" : "";
      return say(`words.arc_${back}${side}`, { angle, radius: number(radius, { decimals: 1 }) });
    }
  }
}

function straightKey(s: Segment): string {
  const direction = s.direction_rad ?? 0;
  const sideways = Math.abs(Math.sin(direction)) > Math.SQRT1_2;
  if (sideways)
    return Math.sin(direction) * Math.sign(s.length_m || 1) > 0 ? "sideways_left" : "sideways_right";
  const ahead = Math.cos(direction) * Math.sign(s.length_m || 1) > 0;
  return ahead ? "drive" : "back";
}

export function capitalise(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
