import type { DryRun, MotionMode, NewJobOrder, Plant, StepPreview } from "@/shared/api/types";
import { bracketsWanted, type BracketsDraft, type BracketsFault } from "@/shared/body/bracketStep";
import { liftAt, stepActions, type Scene, type Transfer } from "./tourActions";

/** A job order being written: stations in the order they will be visited. */
export interface TourStep {
  id: number;
  station: string; // as typed
  mode: MotionMode;
  feet?: boolean; // as a person wants it; absent: as the station is for
  transfer?: Transfer | undefined;
  brackets?: BracketsDraft | undefined;
}
export interface Tour {
  vehicle: string; // empty: any that can
  priority: number;
  steps: TourStep[];
  nextId: number;
}

export type TourEvent =
  | { kind: "vehicle"; vehicle: string }
  | { kind: "priority"; priority: number }
  | { kind: "add"; station?: string }
  | { kind: "remove"; id: number }
  | { kind: "move"; id: number; by: -1 | 1 }
  | { kind: "station"; id: number; station: string }
  | { kind: "mode"; id: number; mode: MotionMode }
  | { kind: "feet"; id: number; feet: boolean }
  | { kind: "transfer"; id: number; transfer: Transfer | undefined }
  | { kind: "brackets"; id: number; brackets: BracketsDraft | undefined }
  | { kind: "reset" };

export const kMaxSteps = 100;

export function emptyTour(): Tour {
  return { vehicle: "", priority: 0, steps: [{ id: 1, station: "", mode: "auto" }], nextId: 2 };
}

export function tour(state: Tour, event: TourEvent): Tour {
  switch (event.kind) {
    case "vehicle":
      return { ...state, vehicle: event.vehicle };
    case "priority":
      return { ...state, priority: Math.max(-100, Math.min(100, Math.round(event.priority))) };
    case "add":
      if (state.steps.length >= kMaxSteps) return state;
      return {
        ...state,
        steps: [...state.steps, { id: state.nextId, station: event.station ?? "", mode: "auto" }],
        nextId: state.nextId + 1,
      };
    case "remove":
      if (state.steps.length === 1) return state;
      return { ...state, steps: state.steps.filter((s) => s.id !== event.id) };
    case "move": {
      const from = state.steps.findIndex((s) => s.id === event.id);
      const to = from + event.by;
      const moving = state.steps[from];
      const other = state.steps[to];
      if (!moving || !other) return state;
      const steps = [...state.steps];
      steps[from] = other;
      steps[to] = moving;
      return { ...state, steps };
    }
    case "station":
      // What was to be done at the other station is not meant for this one.
      return withStep(state, event.id, ({ id, mode }) => ({
        id,
        mode,
        station: event.station.replace(/[^0-9]/g, "").slice(0, 4),
      }));
    case "mode":
      return withStep(state, event.id, (s) => ({ ...s, mode: event.mode }));
    case "feet":
      return withStep(state, event.id, (s) => ({ ...s, feet: event.feet }));
    case "transfer":
      return withStep(state, event.id, (s) => ({ ...s, transfer: event.transfer }));
    case "brackets":
      return withStep(state, event.id, (s) => ({ ...s, brackets: event.brackets }));
    case "reset":
      return emptyTour();
  }
}

function withStep(state: Tour, id: number, change: (step: TourStep) => TourStep): Tour {
  return { ...state, steps: state.steps.map((s) => (s.id === id ? change(s) : s)) };
}

export type TourFault =
  | { kind: "missing"; id: number }
  | { kind: "unknown"; id: number; station: string }
  | { kind: "wrong_type"; id: number; station: string }
  | { kind: "repeated"; id: number; station: string }
  | { kind: `brackets_${BracketsFault}`; id: number };

/** What the server would refuse for sure, named by row; the rest it decides. */
export function faults(state: Tour, plant: Plant | undefined): TourFault[] {
  const found: TourFault[] = [];
  const type = plant?.vehicles.find((v) => v.id === state.vehicle)?.type;
  state.steps.forEach((step, i) => {
    if (step.station === "") {
      found.push({ kind: "missing", id: step.id });
      return;
    }
    const station = plant?.stations.find((s) => s.number === Number(step.station));
    const only = station?.vehicle_types ?? [];
    if (type !== undefined && only.length > 0 && !only.includes(type))
      found.push({ kind: "wrong_type", id: step.id, station: step.station });
    if (plant && station === undefined) found.push({ kind: "unknown", id: step.id, station: step.station });
    const lift = step.brackets && station && liftAt(station, state.vehicle, plant);
    const { fault } = bracketsWanted(step.brackets, lift);
    if (fault !== undefined) found.push({ kind: `brackets_${fault}`, id: step.id });
    const before = state.steps[i - 1];
    if (before && before.station !== "" && Number(before.station) === Number(step.station))
      found.push({ kind: "repeated", id: step.id, station: step.station });
  });
  return found;
}

/** The body of POST /job-orders. REQUIRES: no faults. */
export function toRequest(state: Tour, scene: Scene): NewJobOrder {
  const actions = stepActions(state, scene);
  return {
    ...(state.vehicle ? { vehicle: state.vehicle } : {}),
    priority: state.priority,
    steps: state.steps.map((s, i) => ({ station: Number(s.station), motion_mode: s.mode, ...actions[i] })),
  };
}

/** The way that a step would be driven, or why none leads there. */
export function chosenOf(step: StepPreview, wanted: MotionMode) {
  if (wanted !== "auto") return step.options.find((o) => o.mode === wanted);
  return (
    step.options.find((o) => o.suggested && o.feasible) ??
    step.options.find((o) => o.mode === step.chosen && o.feasible) ??
    step.options[0]
  );
}

/** Seconds of all drives together; undefined while one of them cannot be driven. */
export function tourTime(state: Tour, preview: DryRun): number | undefined {
  let total = 0;
  for (const [i, step] of preview.steps.entries()) {
    const option = chosenOf(step, state.steps[i]?.mode ?? "auto");
    if (option?.feasible !== true || option.duration_s === undefined) return undefined;
    total += option.duration_s;
  }
  return total;
}
