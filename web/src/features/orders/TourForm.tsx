import { useCallback, useReducer, useRef } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { JobOrder, MotionMode, Plant } from "@/shared/api/types";
import { useCommandsEnabled, useMayCommand, useVehicles } from "@/shared/live";
import { navigate } from "@/shared/router";
import { Button, Card, CommandButton, Icon } from "@/shared/ui";
import { useCommand } from "@/shared/ui/useCommand";
import { useWords } from "@/shared/words/useWords";
import { emptyTour, faults, toRequest, tour, type TourFault } from "./tour";

const modes: readonly MotionMode[] = [
  "auto",
  "linear",
  "fixed_axis_rotation",
  "self_rotation",
  "lateral",
  "oblique",
  "combined",
  "free",
];

function newKey(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (b) => b.toString(16).padStart(2, "0")).join("");
}

/** A new job order with one or more stations. */
export function TourForm({ plant, onClose }: { plant: Plant | undefined; onClose: () => void }) {
  const { t } = useTranslation("orders");
  const words = useWords();
  const vehicles = useVehicles();
  const linkUp = useCommandsEnabled();
  const mayCommand = useMayCommand();
  const [state, dispatch] = useReducer(tour, undefined, emptyTour);
  const wrong = faults(state, plant);
  const body = toRequest(state);
  // One key for one content: asking again after a lost answer stays one order, a changed order is another.
  const text = JSON.stringify(body);
  const key = useRef({ text: "", key: "" });
  const { asked, run } = useCommand(
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
  const disabled = !linkUp
    ? t("command.offline")
    : !mayCommand
      ? t("command.not_allowed")
      : wrong.length > 0
        ? t("tour.fix")
        : undefined;
  return (
    <Card
      className="odetail tour"
      title={t("tour.title")}
      right={
        <Button quiet onPress={onClose}>
          {t("tour.cancel")}
        </Button>
      }
    >
      <div className="fields">
        <label className="field">
          <span className="cap">{t("tour.vehicle")}</span>
          <select
            value={state.vehicle}
            onChange={(e) => dispatch({ kind: "vehicle", vehicle: e.target.value })}
          >
            <option value="">{t("tour.any")}</option>
            {vehicles.map((v) => (
              <option key={v.id} value={v.id}>
                {v.name}
              </option>
            ))}
          </select>
        </label>
        <label className="field">
          <span className="cap">{t("tour.priority")}</span>
          <input
            type="number"
            min={-100}
            max={100}
            value={state.priority}
            onChange={(e) => dispatch({ kind: "priority", priority: Number(e.target.value) || 0 })}
          />
        </label>
      </div>
      <h3 className="cap">{t("tour.stations")}</h3>
      <ol className="tourlist">
        {state.steps.map((step, i) => {
          const fault = wrong.find((f) => f.id === step.id && f.kind !== "missing");
          const station = plant?.stations.find((s) => String(s.number) === step.station);
          const index = i + 1;
          return (
            <li key={step.id}>
              <b aria-hidden="true">{index}</b>
              <input
                type="text"
                inputMode="numeric"
                aria-label={t("tour.station", { index })}
                aria-invalid={fault !== undefined}
                value={step.station}
                onChange={(e) => dispatch({ kind: "station", id: step.id, station: e.target.value })}
              />
              <select
                aria-label={t("tour.mode", { index })}
                value={step.mode}
                onChange={(e) => dispatch({ kind: "mode", id: step.id, mode: e.target.value as MotionMode })}
              >
                {modes.map((mode) => (
                  <option key={mode} value={mode}>
                    {words.mode(mode)}
                  </option>
                ))}
              </select>
              <button
                type="button"
                className="btn icon up"
                aria-label={t("tour.up", { index })}
                disabled={i === 0}
                onClick={() => dispatch({ kind: "move", id: step.id, by: -1 })}
              >
                <Icon name="chev" />
              </button>
              <button
                type="button"
                className="btn icon"
                aria-label={t("tour.down", { index })}
                disabled={i === state.steps.length - 1}
                onClick={() => dispatch({ kind: "move", id: step.id, by: 1 })}
              >
                <Icon name="chev" />
              </button>
              <button
                type="button"
                className="btn icon"
                aria-label={t("tour.remove", { index })}
                disabled={state.steps.length === 1}
                onClick={() => dispatch({ kind: "remove", id: step.id })}
              >
                <Icon name="x" />
              </button>
              <span className={fault ? "lab bad" : "lab"}>
                {fault ? faultText(fault) : (station?.name ?? "")}
              </span>
            </li>
          );
        })}
      </ol>
      <div className="row tourfoot">
        <Button icon="plus" onPress={() => dispatch({ kind: "add" })}>
          {t("tour.add")}
        </Button>
        <span className="grow" />
        <CommandButton
          label={t("tour.create")}
          progress={asked.kind === "requested" ? { kind: "requested", atMs: asked.atMs } : { kind: "ready" }}
          disabledReason={disabled}
          onRun={run}
        />
      </div>
      {asked.kind === "failed" && (
        <p className="lab bad" role="alert">
          {asked.problem.status === 0
            ? t("tour.again")
            : t("tour.refused", { detail: words.problem(asked.problem) })}
        </p>
      )}
    </Card>
  );

  function faultText(fault: TourFault): string {
    return t(`tour.${fault.kind}`, { station: "station" in fault ? fault.station : "" });
  }
}
