import { useCallback, useMemo, useReducer, useRef } from "react";
import { useTranslation } from "react-i18next";
import { api, ApiProblem, call } from "@/shared/api";
import type { JobOrder, Plant } from "@/shared/api/types";
import { useCommandsEnabled, useMayCommand, useStations, useVehicle } from "@/shared/live";
import { navigate } from "@/shared/router";
import { useCommand } from "@/shared/ui/useCommand";
import { useWords } from "@/shared/words/useWords";
import { chosenOf, emptyTour, faults, toRequest, tour, tourTime } from "./tour";
import { arrivals, type Scene } from "./tourActions";
import { useTourPreview } from "./useTourPreview";

function newKey(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (b) => b.toString(16).padStart(2, "0")).join("");
}

const isAnswered = (error: unknown) =>
  error instanceof ApiProblem && error.status >= 400 && error.status < 500;

/** Stores the order `text`, which is made of what a person has `written`, and goes to it. */
function useStore(written: string, text: string) {
  // One key for one content: asking again after a lost answer stays one order, a changed order is another. After a lost
  // answer the same text is asked for again, though where the vehicle stands by now would make another: it may have begun.
  const sent = useRef<{ written: string; text: string; key: string; answered: boolean }>(undefined);
  return useCommand(
    useCallback(async () => {
      const last = sent.current;
      const again = last?.written === written && (!last.answered || last.text === text);
      const now = again ? last : { written, text, key: newKey(), answered: false };
      sent.current = now;
      try {
        const order = (await call(
          api.POST("/api/v1/job-orders", {
            params: { header: { "Idempotency-Key": now.key } },
            body: JSON.parse(now.text),
          }),
        )) as JobOrder;
        navigate(`/orders/${order.id}`);
      } catch (error) {
        now.answered = isAnswered(error);
        throw error;
      }
    }, [written, text]),
  );
}

function useScene(plant: Plant | undefined, vehicle: string): Scene {
  const stations = useStations();
  return {
    plant,
    vehicle: useVehicle(vehicle || undefined),
    there: new Map(
      stations.flatMap(({ id, state }) => (state?.load === undefined ? [] : [[id, state.load]])),
    ),
  };
}

/** A tour being written: what is wrong with it, what the server would make of it, and its command. */
export function useTour(plant: Plant | undefined) {
  const { t } = useTranslation("orders");
  const words = useWords();
  const linkUp = useCommandsEnabled();
  const mayCommand = useMayCommand();
  const [state, dispatch] = useReducer(tour, undefined, emptyTour);
  const wrong = faults(state, plant);
  const scene = useScene(plant, state.vehicle);
  const text = JSON.stringify(toRequest(state, scene));
  const command = useStore(JSON.stringify(state), text);
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
    arrivals: arrivals(state, scene),
    data,
    asking: preview.kind === "loading",
    problem,
    time: data && tourTime(state, data),
    areas,
    disabledReason,
    command,
  };
}
