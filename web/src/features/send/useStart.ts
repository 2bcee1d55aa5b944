import { useQuery } from "@tanstack/react-query";
import { useCallback, useEffect, useReducer, useRef } from "react";
import { api, ApiProblem, call } from "@/shared/api";
import type { JobOrder, NewJobOrder } from "@/shared/api/types";
import { navigate, useLocation } from "@/shared/router";
import { useJobOrder, useNow } from "@/shared/live";
import { goGuard } from "@/shared/ui";
import { startCommand, type StartCommand } from "./startCommand";

export interface Start {
  command: StartCommand;
  nowMs: number;
  arm: () => void;
  start: () => void;
  hold: () => void;
  cancel: () => void;
  retry: () => void;
  done: () => void;
}

/** A key that no other command has; the same for every try of this one. */
function newKey(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (b) => b.toString(16).padStart(2, "0")).join("");
}

/** Runs the two-step start. `body` is what would be sent now; undefined while it must not be. */
export function useStart(body: NewJobOrder | undefined): Start {
  const [command, dispatch] = useReducer(startCommand, { kind: "idle" });
  const { query } = useLocation();
  const nowMs = useNow(200).monoMs;
  const bodyText = body === undefined ? undefined : JSON.stringify(body);
  const bodyRef = useRef(body);
  useEffect(() => {
    bodyRef.current = body;
  });

  useEffect(() => dispatch({ kind: "tick", nowMs }), [nowMs]);
  useEffect(() => {
    dispatch({
      kind: "subject",
      body: bodyText === undefined ? undefined : (JSON.parse(bodyText) as NewJobOrder),
    });
  }, [bodyText]);

  const sentTry = command.kind === "requested" ? `${command.key}#${command.tries}` : undefined;
  const requested = useRef<{ key: string; body: NewJobOrder }>(undefined);
  useEffect(() => {
    requested.current = command.kind === "requested" ? { key: command.key, body: command.body } : undefined;
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
        const station = sent.body.steps[0]?.station;
        dispatch({ kind: "accepted", orderId: order.id, vehicle: sent.body.vehicle ?? "", station });
        navigate(`/send?order=${order.id}`, { replace: true });
      },
      (error: unknown) => {
        const problem =
          error instanceof ApiProblem ? error : new ApiProblem({ status: 0, code: "unexpected_answer" });
        // Without an answer nobody knows whether it is stored: only asking again with the same key tells.
        if (problem.status === 0) {
          dispatch({ kind: "unanswered", why: problem.code === "no_answer" ? "timeout" : "network" });
        } else dispatch({ kind: "refused", problem });
      },
    );
  }, [sentTry]);

  // The address keeps the order, so that coming back to this page shows its progress again.
  const orderId = query.get("order");
  useEffect(() => {
    if (orderId) dispatch({ kind: "accepted", orderId, vehicle: "", station: undefined });
  }, [orderId]);

  const arm = useCallback(() => {
    const armed = bodyRef.current;
    if (armed && goGuard.takes(performance.now()))
      dispatch({ kind: "arm", key: newKey(), body: armed, nowMs: performance.now() });
  }, []);
  const hold = useCallback(() => {
    const held = bodyRef.current;
    if (held && goGuard.takes(performance.now()))
      dispatch({ kind: "hold", key: newKey(), body: held, nowMs: performance.now() });
  }, []);
  const start = useCallback(() => dispatch({ kind: "start", nowMs: performance.now() }), []);
  const cancel = useCallback(() => dispatch({ kind: "cancel" }), []);
  const retry = useCallback(() => dispatch({ kind: "retry", nowMs: performance.now() }), []);
  const done = useCallback(() => {
    dispatch({ kind: "done" });
    navigate("/send", { replace: true });
  }, []);
  return { command, nowMs, arm, start, hold, cancel, retry, done };
}

/** The order that was sent: from the stream, or asked for once when it is no longer among the newest. */
export function useSentOrder(id: string | undefined): JobOrder | undefined {
  const live = useJobOrder(id);
  const { data } = useQuery({
    queryKey: ["job-order", id],
    queryFn: () => call(api.GET("/api/v1/job-orders/{id}", { params: { path: { id: id ?? "" } } })),
    enabled: id !== undefined && live === undefined,
    retry: false,
  });
  return id === undefined ? undefined : (live ?? data);
}
