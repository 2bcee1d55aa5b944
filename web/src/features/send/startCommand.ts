import type { Problem, Vehicle } from "../../shared/api/types";

/**
 * The two-step start. The idempotency key is made when the command is armed and kept until it is
 * answered, so that any number of presses, retries and broken connections is one command.
 */
export type StartCommand =
  | { kind: "idle" }
  | { kind: "armed"; key: string; subject: string; untilMs: number }
  | { kind: "requested"; key: string; sinceMs: number; tries: number }
  | { kind: "accepted"; orderId: string; orderName: string; vehicle: string; atMs: number }
  | { kind: "refused"; problem: Problem }
  | { kind: "unanswered"; key: string; why: "timeout" | "network" };

export type StartEvent =
  | { kind: "arm"; key: string; subject: string; nowMs: number }
  | { kind: "start"; nowMs: number }
  | { kind: "hold"; key: string; nowMs: number }
  | { kind: "tick"; nowMs: number }
  | { kind: "subject"; subject: string }
  | { kind: "cancel" }
  | { kind: "accepted"; orderId: string; orderName: string; vehicle: string; nowMs: number }
  | { kind: "refused"; problem: Problem }
  | { kind: "unanswered"; why: "timeout" | "network" }
  | { kind: "retry"; nowMs: number }
  | { kind: "done" };

export const kArmMs = 8000;
export const kHoldMs = 1500;
export const kAnswerMs = 10000;

export function startCommand(state: StartCommand, event: StartEvent): StartCommand {
  switch (event.kind) {
    case "arm":
      if (state.kind !== "idle" && state.kind !== "refused") return state;
      return { kind: "armed", key: event.key, subject: event.subject, untilMs: event.nowMs + kArmMs };
    case "start":
      if (state.kind !== "armed") return state;
      if (event.nowMs >= state.untilMs) return { kind: "idle" };
      return { kind: "requested", key: state.key, sinceMs: event.nowMs, tries: 1 };
    case "hold":
      if (state.kind === "armed")
        return { kind: "requested", key: state.key, sinceMs: event.nowMs, tries: 1 };
      if (state.kind !== "idle" && state.kind !== "refused") return state;
      return { kind: "requested", key: event.key, sinceMs: event.nowMs, tries: 1 };
    case "tick":
      return state.kind === "armed" && event.nowMs >= state.untilMs ? { kind: "idle" } : state;
    case "subject":
      // What was armed is no longer what would be sent.
      return state.kind === "armed" && state.subject !== event.subject ? { kind: "idle" } : state;
    case "cancel":
      return state.kind === "armed" || state.kind === "refused" ? { kind: "idle" } : state;
    case "accepted":
      if (state.kind !== "requested") return state;
      return {
        kind: "accepted",
        orderId: event.orderId,
        orderName: event.orderName,
        vehicle: event.vehicle,
        atMs: event.nowMs,
      };
    case "refused":
      return state.kind === "requested" ? { kind: "refused", problem: event.problem } : state;
    case "unanswered":
      return state.kind === "requested" ? { kind: "unanswered", key: state.key, why: event.why } : state;
    case "retry":
      if (state.kind !== "unanswered") return state;
      return { kind: "requested", key: state.key, sinceMs: event.nowMs, tries: 2 };
    case "done":
      return state.kind === "requested" ? state : { kind: "idle" };
  }
}

/** What an armed command is about; when it changes the arming lapses. */
export function subjectOf(vehicle: Vehicle | undefined, station: number | undefined, mode: string | undefined): string {
  return `${vehicle?.id ?? ""}|${station ?? ""}|${mode ?? ""}`;
}
