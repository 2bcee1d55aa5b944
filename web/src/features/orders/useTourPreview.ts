import { useEffect, useState } from "react";
import { api, ApiProblem, call } from "@/shared/api";
import type { DryRun } from "@/shared/api/types";

export type TourPreview =
  | { kind: "none" }
  | { kind: "loading" }
  | { kind: "ready"; data: DryRun }
  | { kind: "failed"; problem: ApiProblem };

const kDebounceMs = 300;

/** What the server would make of the order; asked once typing has paused. Undefined asks nothing. */
export function useTourPreview(body: string | undefined): TourPreview {
  const [answer, setAnswer] = useState<{ body: string; preview: TourPreview }>();
  useEffect(() => {
    if (body === undefined) return;
    let newest = true;
    const timer = setTimeout(() => {
      call(api.POST("/api/v1/job-orders", { params: { query: { dryRun: true } }, body: JSON.parse(body) }))
        .then(
          (data): TourPreview => ({ kind: "ready", data: data as DryRun }),
          (error: unknown): TourPreview => ({
            kind: "failed",
            problem:
              error instanceof ApiProblem ? error : new ApiProblem({ status: 0, code: "unexpected_answer" }),
          }),
        )
        .then((preview) => newest && setAnswer({ body, preview }));
    }, kDebounceMs);
    return () => {
      newest = false;
      clearTimeout(timer);
    };
  }, [body]);
  if (body === undefined) return { kind: "none" };
  return answer?.body === body ? answer.preview : { kind: "loading" };
}
