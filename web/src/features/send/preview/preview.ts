import type { DryRun, ModeOption, MotionMode, Pose, Reason, Vehicle } from "@/shared/api/types";
import type { BracketsFault } from "@/shared/body/bracketStep";
import type { ShownCheck } from "../steps/wayChecks";
import type { Refusal } from "../start/startCommand";
import type { StationEntry } from "../steps/stationEntry";

export type StepPreview = DryRun["steps"][number];

/** What the preview depends on. Same key, same answer: nothing is asked again. */
export interface PreviewInput {
  vehicle: string;
  station: number;
  mode: MotionMode;
  pose: Pose | undefined;
  link: string;
  stationsKey: string;
  /** Orders that the vehicle ends first: the move begins where they end, wherever it is now. */
  after: string;
}

/** Poses are rounded to what can change the answer (10 mm, 0.1 deg), so noise at rest asks nothing. */
export function previewKey(input: PreviewInput): string {
  const p = input.after === "" ? input.pose : undefined;
  const pose = p
    ? `${Math.round(p.x_m * 100)},${Math.round(p.y_m * 100)},${Math.round((p.heading_rad * 1800) / Math.PI)}`
    : "-";
  return [input.vehicle, input.station, input.mode, pose, input.link, input.stationsKey, input.after].join(
    "|",
  );
}

export type Preview =
  | { kind: "none" }
  | { kind: "loading"; last: DryRun | undefined }
  | { kind: "ready"; data: DryRun }
  | { kind: "failed"; problem: Refusal };

/** Asks for previews; only the answer to the newest question is let through. */
export class NewestOnly {
  private turn = 0;
  next(): { isNewest: () => boolean } {
    const mine = ++this.turn;
    return { isNewest: () => mine === this.turn };
  }
  drop(): void {
    ++this.turn;
  }
}

export const kDebounceMs = 250;

const order: Record<ShownCheck["result"], number> = { fail: 0, note: 1, pass: 2 };

/** What a note says of the way there: the order is taken, and the vehicle waits. */
const kWaits = new Set<ShownCheck["code"]>(["station", "clearance", "mode"]);
export const makesWait = (check: ShownCheck) => check.result === "note" && kWaits.has(check.code);

/** Fails on top, then what makes it wait; within one result the server's order stays, and notes keep their place. */
export function sortChecks(checks: readonly ShownCheck[]): ShownCheck[] {
  const rank = (c: ShownCheck) => (c.result === "fail" ? 0 : makesWait(c) ? 1 : 2);
  return [...checks].sort((a, b) => rank(a) - rank(b));
}

/** On a small screen the passed ones stand in one line that opens, so that no failed one is below the edge. */
export function foldChecks(
  checks: readonly ShownCheck[],
  narrow: boolean,
): { rows: ShownCheck[]; folded: ShownCheck[] } {
  const sorted = sortChecks(checks);
  if (!narrow) return { rows: sorted, folded: [] };
  return {
    rows: sorted.filter((c) => c.result !== "pass"),
    folded: sorted.filter((c) => c.result === "pass"),
  };
}

export function worst(checks: readonly ShownCheck[]): ShownCheck["result"] | undefined {
  return checks.reduce<ShownCheck["result"] | undefined>(
    (w, c) => (w === undefined || order[c.result] < order[w] ? c.result : w),
    undefined,
  );
}

export type CheckSum = Record<"fail" | "wait" | "note" | "pass", number>;

/** Each check counts once, under what it means for the start: fails, makes it wait, is to be noted, passes. */
export function countChecks(checks: readonly ShownCheck[]): CheckSum {
  const of = (has: (c: ShownCheck) => boolean) => checks.filter(has).length;
  return {
    fail: of((c) => c.result === "fail"),
    wait: of(makesWait),
    note: of((c) => c.result === "note" && !makesWait(c)),
    pass: of((c) => c.result === "pass"),
  };
}

const modeOrder: MotionMode[] = [
  "linear",
  "free",
  "fixed_axis_rotation",
  "self_rotation",
  "lateral",
  "oblique",
  "combined",
];

/** Feasible ones first, the suggested one on top; the rest in a fixed order so rows do not jump. */
export function sortOptions(options: readonly ModeOption[]): ModeOption[] {
  const rank = (o: ModeOption) =>
    (o.suggested ? 0 : o.feasible ? 10 : 20) + Math.max(0, modeOrder.indexOf(o.mode)) / 10;
  return [...options].sort((a, b) => rank(a) - rank(b));
}

/** The row that a start would send now: the person's choice, or the suggested one for auto. */
export function chosenOption(step: StepPreview | undefined, mode: MotionMode): ModeOption | undefined {
  if (!step) return undefined;
  if (mode === "auto") {
    return (
      step.options.find((o) => o.suggested && o.feasible) ??
      step.options.find((o) => o.mode === step.chosen && o.feasible)
    );
  }
  return step.options.find((o) => o.mode === mode);
}

/** While it drives without an order, nothing that is worked out from where it is stays true for long. */
export const isOnItsWay = (v: Vehicle) =>
  v.leg !== undefined && (v.activity === "moving" || v.activity === "measuring");

/** Whether Start may be armed, and if not, the first reason in the order a person would fix it. */
export type Readiness =
  | { kind: "ready" }
  | { kind: "no_vehicle" }
  | { kind: "no_station" }
  | { kind: "offline" }
  | { kind: "not_allowed" }
  | { kind: "unknown_station"; number: string }
  | { kind: "wrong_type"; number: string }
  | { kind: "on_its_way"; vehicle: string }
  | { kind: "brackets"; fault: BracketsFault }
  | { kind: "waiting" }
  | { kind: "infeasible"; option: ModeOption }
  | { kind: "check"; check: ShownCheck }
  | { kind: "problem"; reason: Reason }
  | { kind: "failed" };

export function readiness(input: {
  vehicle: Vehicle | undefined;
  entry: StationEntry;
  mode: MotionMode;
  linkUp: boolean;
  mayCommand: boolean;
  preview: Preview;
  floor?: ShownCheck | undefined;
  /** It has an order, or one waits for it: the move begins after that, from a place that is known. */
  busy?: boolean;
  /** What is wrong with the height to which its brackets go on arrival. */
  brackets?: BracketsFault | undefined;
}): Readiness {
  if (!input.linkUp) return { kind: "offline" };
  if (!input.mayCommand) return { kind: "not_allowed" };
  if (!input.vehicle) return { kind: "no_vehicle" };
  const { entry } = input;
  if (entry.kind === "empty") return { kind: "no_station" };
  if (entry.kind === "unknown") return { kind: "unknown_station", number: entry.digits };
  if (entry.kind === "wrong_type") return { kind: "wrong_type", number: String(entry.station.number) };
  if (!input.busy && isOnItsWay(input.vehicle)) return { kind: "on_its_way", vehicle: input.vehicle.id };
  if (input.brackets !== undefined) return { kind: "brackets", fault: input.brackets };
  const { preview } = input;
  if (preview.kind === "failed") return { kind: "failed" };
  if (preview.kind !== "ready") return { kind: "waiting" };
  const checks: ShownCheck[] = [...(input.floor ? [input.floor] : []), ...preview.data.checks];
  const fail = checks.find((c) => c.result === "fail");
  const [step] = preview.data.steps;
  const option = chosenOption(step, input.mode);
  if (option && !option.feasible) return { kind: "infeasible", option };
  if (fail) return { kind: "check", check: fail };
  if (!preview.data.accepted) {
    return preview.data.problem ? { kind: "problem", reason: preview.data.problem } : { kind: "failed" };
  }
  if (option) return { kind: "ready" };
  // Nothing leads there, e.g. because it stands there already: a start would send nothing.
  const why = step?.options.find((o) => o.reason)?.reason;
  return why ? { kind: "problem", reason: why } : { kind: "failed" };
}
