import type { ApiProblem } from "@/shared/api";
import type { NewJobOrder } from "@/shared/api/types";
import { armedLeftMs, isLapsed, isSameTap } from "@/shared/ui/arming";
import type { Replaced } from "../busy/replacing";

export type Refusal = Pick<ApiProblem, "code" | "params" | "detail" | "requestId">;

/** What a start would do now: the order it would store, and behind which others that would wait. */
export interface Subject {
  body: NewJobOrder;
  /** Orders that the vehicle ends first; empty: it begins at once. */
  after: string;
}

/**
 * The two-step start. The idempotency key is made when the command is armed and kept until it is
 * answered, so that any number of presses, retries and broken connections is one command.
 */
export type StartCommand =
  | { kind: "idle" }
  | { kind: "armed"; key: string; subject: Subject; sinceMs: number }
  | ({ kind: "requested"; sinceMs: number } & Sent)
  | { kind: "accepted"; orderId: string; vehicle: string; station: number | undefined }
  | { kind: "refused"; problem: Refusal; replaces?: Replaced }
  | ({ kind: "unanswered"; why: "timeout" | "network" } & Sent);

/** What is asked of the server, the same at every try. */
export interface Sent {
  key: string;
  body: NewJobOrder;
  tries: number;
  /** The order that is cancelled once this one is stored. */
  replaces?: Replaced;
}

export type StartEvent =
  | { kind: "arm"; key: string; subject: Subject; nowMs: number }
  | { kind: "start"; nowMs: number }
  | { kind: "hold"; key: string; subject: Subject; nowMs: number }
  | { kind: "replace"; key: string; body: NewJobOrder; order: Replaced; nowMs: number }
  | { kind: "tick"; nowMs: number }
  | { kind: "subject"; subject: Subject | undefined }
  | { kind: "cancel" }
  | { kind: "accepted"; orderId: string; vehicle: string; station: number | undefined }
  | { kind: "refused"; problem: Refusal }
  | { kind: "unanswered"; why: "timeout" | "network" }
  | { kind: "retry"; nowMs: number }
  | { kind: "done" };

export function startCommand(state: StartCommand, event: StartEvent): StartCommand {
  switch (event.kind) {
    case "arm":
      if (state.kind !== "idle" && state.kind !== "refused") return state;
      return { kind: "armed", key: event.key, subject: event.subject, sinceMs: event.nowMs };
    case "start":
      if (state.kind !== "armed" || isSameTap(state.sinceMs, event.nowMs)) return state;
      if (isLapsed(state.sinceMs, event.nowMs)) return { kind: "idle" };
      return request(state.key, state.subject.body, event.nowMs);
    case "hold": {
      if (state.kind !== "idle" && state.kind !== "refused" && state.kind !== "armed") return state;
      const from = state.kind === "armed" ? state : event;
      return request(from.key, from.subject.body, event.nowMs);
    }
    case "replace":
      // Armed and confirmed by a button of its own; an arming of Start is dropped for it.
      if (state.kind !== "idle" && state.kind !== "refused" && state.kind !== "armed") return state;
      return { ...request(event.key, event.body, event.nowMs), replaces: event.order };
    case "tick":
      return state.kind === "armed" && isLapsed(state.sinceMs, event.nowMs) ? { kind: "idle" } : state;
    case "subject":
      // What was armed is no longer what would be sent.
      return state.kind === "armed" && !same(state.subject, event.subject) ? { kind: "idle" } : state;
    case "cancel":
      return state.kind === "armed" || state.kind === "refused" ? { kind: "idle" } : state;
    case "accepted":
      if (state.kind !== "requested" && state.kind !== "idle") return state;
      return { kind: "accepted", orderId: event.orderId, vehicle: event.vehicle, station: event.station };
    case "refused":
      if (state.kind !== "requested") return state;
      return { kind: "refused", problem: event.problem, ...replaced(state) };
    case "unanswered":
      if (state.kind !== "requested") return state;
      return { ...sentOf(state), kind: "unanswered", why: event.why };
    case "retry":
      if (state.kind !== "unanswered") return state;
      return { ...sentOf(state), kind: "requested", sinceMs: event.nowMs, tries: state.tries + 1 };
    case "done":
      return state.kind === "requested" ? state : { kind: "idle" };
  }
}

/** Seconds left of an arming, for the ring. */
export function armedLeft_s(state: StartCommand, nowMs: number): number {
  return state.kind === "armed" ? armedLeftMs(state.sinceMs, nowMs) / 1000 : 0;
}

function request(key: string, body: NewJobOrder, sinceMs: number): StartCommand & { kind: "requested" } {
  return { kind: "requested", key, body, sinceMs, tries: 1 };
}

const replaced = ({ replaces }: Sent) => (replaces === undefined ? {} : { replaces });
const sentOf = (state: Sent): Sent => ({
  key: state.key,
  body: state.body,
  tries: state.tries,
  ...replaced(state),
});

function same(a: Subject, b: Subject | undefined): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}
