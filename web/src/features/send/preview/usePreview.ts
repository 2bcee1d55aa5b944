import { useCallback, useEffect, useRef, useState } from "react";
import { api, ApiProblem, call } from "@/shared/api";
import type { DryRun, MotionMode, NewJobOrder } from "@/shared/api/types";
import { kDebounceMs, NewestOnly, type Preview } from "./preview";

/** What is asked: undefined asks nothing. `key` says when an answer is out of date. */
export interface PreviewQuestion {
  key: string;
  vehicle: string;
  station: number;
  mode: MotionMode;
  /** Around the drive, as the order will have them. */
  actions: Pick<NewJobOrder["steps"][number], "before" | "after">;
}

function isAbout(data: DryRun | undefined, question: PreviewQuestion): boolean {
  return data?.vehicle === question.vehicle && data.steps[0]?.number === question.station;
}

function failure(error: unknown): Preview {
  const problem =
    error instanceof ApiProblem ? error : new ApiProblem({ status: 0, code: "unexpected_answer" });
  return { kind: "failed", problem };
}

/**
 * The server's preview of the move, asked again when the question changes. Changes within the debounce
 * time are one question; an answer that is not to the newest question is dropped.
 */
export function usePreview(question: PreviewQuestion | undefined): { preview: Preview; retry: () => void } {
  const [answer, setAnswer] = useState<{ key: string; preview: Preview }>({
    key: "",
    preview: { kind: "none" },
  });
  const [tries, setTries] = useState(0);
  const [newest] = useState(() => new NewestOnly());
  const latest = useRef(question);
  const timer = useRef<ReturnType<typeof setTimeout>>(undefined);
  const key = question === undefined ? undefined : `${question.key}#${tries}`;

  useEffect(() => {
    latest.current = question;
  });

  useEffect(() => {
    if (key === undefined) {
      clearTimeout(timer.current);
      timer.current = undefined;
      newest.drop();
      return;
    }
    // A running timer is kept: a pose that changes all the time must not put the question off for ever.
    timer.current ??= setTimeout(() => {
      timer.current = undefined;
      const asked = latest.current;
      if (asked === undefined) return;
      const turn = newest.next();
      const body = {
        vehicle: asked.vehicle,
        priority: 0,
        steps: [{ station: asked.station, motion_mode: asked.mode, ...asked.actions }],
      };
      call(api.POST("/api/v1/job-orders", { params: { query: { dryRun: true } }, body }))
        .then((data): Preview => ({ kind: "ready", data: data as DryRun }), failure)
        .then((preview) => {
          if (turn.isNewest()) setAnswer({ key: asked.key, preview });
        });
    }, kDebounceMs);
  }, [key, newest]);
  useEffect(() => () => clearTimeout(timer.current), []);

  const retry = useCallback(() => setTries((n) => n + 1), []);
  return { preview: shownPreview(question, answer.preview, answer.key), retry };
}

/** An older answer about the same vehicle and station stays on the screen, marked as being asked again. */
export function shownPreview(
  question: PreviewQuestion | undefined,
  answer: Preview,
  answerKey: string,
): Preview {
  if (question === undefined) return { kind: "none" };
  if (answer.kind === "failed")
    return answerKey === question.key ? answer : { kind: "loading", last: undefined };
  const data = answer.kind === "ready" ? answer.data : undefined;
  if (data === undefined || !isAbout(data, question)) return { kind: "loading", last: undefined };
  return answerKey === question.key ? { kind: "ready", data } : { kind: "loading", last: data };
}
