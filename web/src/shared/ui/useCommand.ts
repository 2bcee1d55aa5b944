import { useCallback, useRef, useState } from "react";
import { ApiProblem } from "@/shared/api";

/** What became of the last request of one command; what the vehicle made of it comes with the stream. */
export type Asked =
  | { kind: "idle" }
  | { kind: "requested"; atMs: number }
  | { kind: "stored"; atMs: number }
  | { kind: "failed"; problem: ApiProblem };

/** Sends a command once, however often it is pressed meanwhile. */
export function useCommand(send: () => Promise<unknown>): {
  asked: Asked;
  run: () => void;
  reset: () => void;
} {
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
