import type { ApiProblem } from "@/shared/api";
import type { NewJobOrder } from "@/shared/api/types";

export type Refusal = Pick<ApiProblem, "code" | "params" | "detail" | "requestId">;

/**
 * The two-step start. The idempotency key is made when the command is armed and kept until it is
 * answered, so that any number of presses, retries and broken connections is one command.
 */
export type StartCommand =
  | { kind: "idle" }
  | { kind: "armed"; key: string; body: NewJobOrder; sinceMs: number }
  | { kind: "requested"; key: string; body: NewJobOrder; sinceMs: number; tries: number }
  | { kind: "accepted"; orderId: string; vehicle: string; station: number | undefined }
  | { kind: "refused"; problem: Refusal }
  | { kind: "unanswered"; key: string; body: NewJobOrder; tries: number; why: "timeout" | "network" };

export type StartEvent =
  | { kind: "arm"; key: string; body: NewJobOrder; nowMs: number }
  | { kind: "start"; nowMs: number }
  | { kind: "hold"; key: string; body: NewJobOrder; nowMs: number }
  | { kind: "tick"; nowMs: number }
  | { kind: "subject"; body: NewJobOrder | undefined }
  | { kind: "cancel" }
  | { kind: "accepted"; orderId: string; vehicle: string; station: number | undefined }
  | { kind: "refused"; problem: Refusal }
  | { kind: "unanswered"; why: "timeout" | "network" }
  | { kind: "retry"; nowMs: number }
  | { kind: "done" };

export const kArmMs = 8000;
export const kHoldMs = 1500;
/** Presses this soon after arming are the same finger: a double tap never starts. */
export const kDwellMs = 350;

export function startCommand(state: StartCommand, event: StartEvent): StartCommand {
  switch (event.kind) {
    case "arm":
      if (state.kind !== "idle" && state.kind !== "refused") return state;
      return { kind: "armed", key: event.key, body: event.body, sinceMs: event.nowMs };
    case "start":
      if (state.kind !== "armed" || event.nowMs - state.sinceMs < kDwellMs) return state;
      if (lapsed(state.sinceMs, event.nowMs)) return { kind: "idle" };
      return { kind: "requested", key: state.key, body: state.body, sinceMs: event.nowMs, tries: 1 };
    case "hold": {
      if (state.kind !== "idle" && state.kind !== "refused" && state.kind !== "armed") return state;
      const from = state.kind === "armed" ? state : event;
      return { kind: "requested", key: from.key, body: from.body, sinceMs: event.nowMs, tries: 1 };
    }
    case "tick":
      return state.kind === "armed" && lapsed(state.sinceMs, event.nowMs) ? { kind: "idle" } : state;
    case "subject":
      // What was armed is no longer what would be sent.
      return state.kind === "armed" && !sameBody(state.body, event.body) ? { kind: "idle" } : state;
    case "cancel":
      return state.kind === "armed" || state.kind === "refused" ? { kind: "idle" } : state;
    case "accepted":
      if (state.kind !== "requested" && state.kind !== "idle") return state;
      return { kind: "accepted", orderId: event.orderId, vehicle: event.vehicle, station: event.station };
    case "refused":
      return state.kind === "requested" ? { kind: "refused", problem: event.problem } : state;
    case "unanswered":
      if (state.kind !== "requested") return state;
      return { kind: "unanswered", key: state.key, body: state.body, tries: state.tries, why: event.why };
    case "retry":
      if (state.kind !== "unanswered") return state;
      return {
        kind: "requested",
        key: state.key,
        body: state.body,
        sinceMs: event.nowMs,
        tries: state.tries + 1,
      };
    case "done":
      return state.kind === "requested" ? state : { kind: "idle" };
  }
}

/** Seconds left of an arming, for the ring. */
export function armedLeft_s(state: StartCommand, nowMs: number): number {
  return state.kind === "armed" ? Math.max(0, (state.sinceMs + kArmMs - nowMs) / 1000) : 0;
}

function lapsed(sinceMs: number, nowMs: number): boolean {
  return nowMs - sinceMs >= kArmMs;
}

function sameBody(a: NewJobOrder, b: NewJobOrder | undefined): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}
