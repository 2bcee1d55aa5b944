import { useQuery, useQueryClient } from "@tanstack/react-query";
import { useCallback, useEffect, useReducer, useRef, useState } from "react";
import { api, ApiProblem, call } from "@/shared/api";
import type { JobOrder, NewJobOrder } from "@/shared/api/types";
import { navigate, useLocation } from "@/shared/router";
import { useJobOrder, useNow } from "@/shared/live";
import { goGuard } from "@/shared/ui";
import { notCancelled, type Replaced, type Replacing } from "../busy/replacing";
import { sendAddress } from "../sendAddress";
import { startCommand, type Sent, type StartCommand, type Subject } from "./startCommand";

export interface Start {
  command: StartCommand;
  /** What became of the order that the new one takes the place of. */
  replacing: Replacing;
  nowMs: number;
  arm: () => void;
  start: () => void;
  hold: () => void;
  replace: (body: NewJobOrder, order: Replaced) => void;
  cancel: () => void;
  retry: () => void;
  done: () => void;
}

/** A key that no other command has; the same for every try of this one. */
function newKey(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (b) => b.toString(16).padStart(2, "0")).join("");
}

const asProblem = (error: unknown) =>
  error instanceof ApiProblem ? error : new ApiProblem({ status: 0, code: "unexpected_answer" });

/** Runs the two-step start. `subject` is what would be sent now; undefined while it must not be. */
export function useStart(subject: Subject | undefined): Start {
  const [command, dispatch] = useReducer(startCommand, { kind: "idle" });
  const [replacing, setReplacing] = useState<Replacing>({ kind: "none" });
  const { query } = useLocation();
  const queries = useQueryClient();
  const nowMs = useNow(200).monoMs;
  const subjectText = subject === undefined ? undefined : JSON.stringify(subject);
  const subjectRef = useRef(subject);
  useEffect(() => {
    subjectRef.current = subject;
  });

  useEffect(() => dispatch({ kind: "tick", nowMs }), [nowMs]);
  useEffect(() => {
    const parsed = subjectText === undefined ? undefined : (JSON.parse(subjectText) as Subject);
    dispatch({ kind: "subject", subject: parsed });
  }, [subjectText]);

  const sentTry = command.kind === "requested" ? `${command.key}#${command.tries}` : undefined;
  const requested = useRef<Sent>(undefined);
  useEffect(() => {
    requested.current = command.kind === "requested" ? command : undefined;
  }, [command]);
  useEffect(() => {
    const sent = requested.current;
    if (sentTry === undefined || sent === undefined) return;
    call(
      api.POST("/api/v1/job-orders", {
        params: { header: { "Idempotency-Key": sent.key } },
        body: sent.body,
      }),
    ).then(
      (data) => {
        const order = data as JobOrder;
        // A link cut at this moment leaves the answer as all that is known of the order.
        queries.setQueryData(sentOrderKey(order.id), order);
        const station = sent.body.steps[0]?.station;
        dispatch({ kind: "accepted", orderId: order.id, vehicle: sent.body.vehicle ?? "", station });
        navigate(sendAddress({ order: order.id }), { replace: true });
        if (sent.replaces) void cancelOther(sent.replaces).then(setReplacing);
        setReplacing(sent.replaces ? { kind: "cancelling", order: sent.replaces } : { kind: "none" });
      },
      (error: unknown) => {
        const problem = asProblem(error);
        // Without an answer nobody knows whether it is stored: only asking again with the same key tells.
        if (problem.status === 0) {
          dispatch({ kind: "unanswered", why: problem.code === "no_answer" ? "timeout" : "network" });
        } else dispatch({ kind: "refused", problem });
      },
    );
  }, [sentTry, queries]);

  // The address keeps the order, so that coming back to this page shows its progress again.
  const orderId = query.get("order");
  useEffect(() => {
    if (orderId) dispatch({ kind: "accepted", orderId, vehicle: "", station: undefined });
    else dispatch({ kind: "done" });
  }, [orderId]);

  const arm = useCallback(() => {
    const armed = subjectRef.current;
    if (armed && goGuard.takes(performance.now()))
      dispatch({ kind: "arm", key: newKey(), subject: armed, nowMs: performance.now() });
  }, []);
  const hold = useCallback(() => {
    const held = subjectRef.current;
    if (held && goGuard.takes(performance.now()))
      dispatch({ kind: "hold", key: newKey(), subject: held, nowMs: performance.now() });
  }, []);
  const start = useCallback(() => dispatch({ kind: "start", nowMs: performance.now() }), []);
  const replace = useCallback((body: NewJobOrder, order: Replaced) => {
    dispatch({ kind: "replace", key: newKey(), body, order, nowMs: performance.now() });
  }, []);
  const cancel = useCallback(() => dispatch({ kind: "cancel" }), []);
  const retry = useCallback(() => dispatch({ kind: "retry", nowMs: performance.now() }), []);
  const done = useCallback(() => {
    dispatch({ kind: "done" });
    setReplacing({ kind: "none" });
    navigate(sendAddress({ order: undefined }), { replace: true });
  }, []);
  return { command, replacing, nowMs, arm, start, hold, replace, cancel, retry, done };
}

/** Only after the new order is stored: see Replacing. */
function cancelOther(order: Replaced): Promise<Replacing> {
  return call(api.POST("/api/v1/job-orders/{id}/cancel", { params: { path: { id: order.id } } })).then(
    (): Replacing => ({ kind: "cancelled", order }),
    (error: unknown) => notCancelled(order, asProblem(error)),
  );
}

const sentOrderKey = (id: string | undefined) => ["job-order", id];

/** The order that was sent: from the stream, or asked for once when it is no longer among the newest. */
export function useSentOrder(id: string | undefined): JobOrder | undefined {
  const live = useJobOrder(id);
  const { data } = useQuery({
    queryKey: sentOrderKey(id),
    queryFn: () => call(api.GET("/api/v1/job-orders/{id}", { params: { path: { id: id ?? "" } } })),
    enabled: id !== undefined && live === undefined,
    retry: false,
  });
  return id === undefined ? undefined : (live ?? data);
}
