import { useCallback, useMemo, useReducer, useRef } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { JobOrder, Plant } from "@/shared/api/types";
import { useCommandsEnabled, useMayCommand } from "@/shared/live";
import { navigate } from "@/shared/router";
import { useCommand } from "@/shared/ui/useCommand";
import { useWords } from "@/shared/words/useWords";
import { chosenOf, emptyTour, faults, toRequest, tour, tourTime } from "./tour";
import { useTourPreview } from "./useTourPreview";

function newKey(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (b) => b.toString(16).padStart(2, "0")).join("");
}

/** Stores the order written as `text` and goes to it. */
function useStore(text: string) {
  // One key for one content: asking again after a lost answer stays one order, a changed order is another.
  const key = useRef({ text: "", key: "" });
  return useCommand(
    useCallback(async () => {
      if (key.current.text !== text) key.current = { text, key: newKey() };
      const order = (await call(
        api.POST("/api/v1/job-orders", {
          params: { header: { "Idempotency-Key": key.current.key } },
          body: JSON.parse(text),
        }),
      )) as JobOrder;
      navigate(`/orders/${order.id}`);
    }, [text]),
  );
}

/** A tour being written: what is wrong with it, what the server would make of it, and its command. */
export function useTour(plant: Plant | undefined) {
  const { t } = useTranslation("orders");
  const words = useWords();
  const linkUp = useCommandsEnabled();
  const mayCommand = useMayCommand();
  const [state, dispatch] = useReducer(tour, undefined, emptyTour);
  const wrong = faults(state, plant);
  const text = JSON.stringify(toRequest(state));
  const command = useStore(text);
  const preview = useTourPreview(wrong.length === 0 && linkUp ? text : undefined);
  const data = preview.kind === "ready" ? preview.data : undefined;
  const problem =
    preview.kind === "failed"
      ? words.problem(preview.problem)
      : data?.accepted === false && data.problem
        ? words.reason(data.problem)
        : undefined;
  const areas = useMemo(
    () =>
      (data?.steps ?? []).flatMap((step, i) => {
        const rings = chosenOf(step, state.steps[i]?.mode ?? "auto")?.swept;
        return rings ? [{ rings, look: "chosen" as const, dash: [] }] : [];
      }),
    [data, state.steps],
  );
  const disabledReason = !linkUp
    ? t("command.offline")
    : !mayCommand
      ? t("command.not_allowed")
      : wrong.length > 0
        ? t("tour.fix")
        : problem;
  return {
    state,
    dispatch,
    wrong,
    data,
    asking: preview.kind === "loading",
    problem,
    time: data && tourTime(state, data),
    areas,
    disabledReason,
    command,
  };
}
