import { useCallback, useEffect, useRef, useState } from "react";
import { useTranslation } from "react-i18next";
import { ApiProblem } from "@/shared/api";
import { useNow } from "@/shared/live/clock";
import type { CommandProgress } from "./command";
import { kShownMs, outcome } from "./outcome";

/** What became of the last request of one command; what the vehicle made of it comes with the stream. */
export type Asked =
  | { kind: "idle" }
  | { kind: "requested"; atMs: number }
  | { kind: "stored"; atMs: number }
  | { kind: "failed"; problem: ApiProblem };

export interface Command {
  asked: Asked;
  run: () => void;
  reset: () => void;
}

/** Sends a command once, however often it is pressed meanwhile. */
export function useCommand(send: () => Promise<unknown>): Command {
  const [asked, setAsked] = useState<Asked>({ kind: "idle" });
  const busy = useRef(false);
  const run = useCallback(() => {
    if (busy.current) return;
    busy.current = true;
    const atMs = performance.now();
    setAsked({ kind: "requested", atMs });
    send()
      .then(
        () => setAsked({ kind: "stored", atMs }),
        (error: unknown) => {
          const known = error instanceof ApiProblem;
          setAsked({
            kind: "failed",
            problem: known ? error : new ApiProblem({ status: 0, code: "unexpected_answer" }),
          });
        },
      )
      .finally(() => {
        busy.current = false;
      });
  }, [send]);
  const reset = useCallback(() => setAsked({ kind: "idle" }), []);
  return { asked, run, reset };
}

/**
 * What the button of a command shows. `reported`: the vehicle or the server has said what was asked for.
 * Every command ends: confirmed for a moment, then ready again; or timed out, with what to do next.
 */
export function useProgress({ asked, reset }: Command, reported: boolean, who: string): CommandProgress {
  const { t } = useTranslation();
  const now = useNow(200).monoMs;
  const stored = asked.kind === "stored";
  const [doneMs, setDoneMs] = useState<number>();
  useEffect(() => {
    setDoneMs((known) => (!stored ? undefined : (known ?? (reported ? performance.now() : undefined))));
  }, [stored, reported]);
  useEffect(() => {
    if (doneMs === undefined) return;
    const timer = setTimeout(reset, kShownMs);
    return () => clearTimeout(timer);
  }, [doneMs, reset]);
  return outcome(asked, doneMs, now, who, {
    what: t("command.no_answer", { name: who }),
    next: t("command.look_there", { name: who }),
  });
}
