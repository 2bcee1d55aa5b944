import { useCallback, useMemo, useReducer, useRef, useState } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { JobOrder, Plant } from "@/shared/api/types";
import { MapView } from "@/shared/map";
import { useCommandsEnabled, useMayCommand, useVehicles } from "@/shared/live";
import { navigate } from "@/shared/router";
import { Button, Card, CommandButton, NumberPad } from "@/shared/ui";
import { useCommand } from "@/shared/ui/useCommand";
import { useWords } from "@/shared/words/useWords";
import { duration } from "@/shared/words/format";
import { chosenOf, emptyTour, faults, toRequest, tour, tourTime } from "./tour";
import { TourRow } from "./TourRow";
import { useTourPreview } from "./useTourPreview";

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
  const preview = useTourPreview(wrong.length === 0 && linkUp ? text : undefined);
  const data = preview.kind === "ready" ? preview.data : undefined;
  const problem =
    preview.kind === "failed"
      ? words.problem(preview.problem)
      : data?.accepted === false && data.problem
        ? words.reason(data.problem)
        : undefined;
  const time = data && tourTime(state, data);
  const [activeId, setActive] = useState(1);
  const active = state.steps.find((s) => s.id === activeId) ?? state.steps[0]!;
  const areas = useMemo(
    () =>
      (data?.steps ?? []).flatMap((step, i) => {
        const rings = chosenOf(step, state.steps[i]?.mode ?? "auto")?.swept;
        return rings ? [{ rings, look: "chosen" as const, dash: [] }] : [];
      }),
    [data, state.steps],
  );
  const about = areas.flatMap((area) => area.rings.flat());
  const disabled = !linkUp
    ? t("command.offline")
    : !mayCommand
      ? t("command.not_allowed")
      : wrong.length > 0
        ? t("tour.fix")
        : problem;
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
        <div className="tourwho" role="group" aria-label={t("tour.vehicle")}>
          {["", ...vehicles.map((v) => v.id)].map((id) => (
            <button
              key={id}
              type="button"
              className="btn"
              aria-pressed={state.vehicle === id}
              onClick={() => dispatch({ kind: "vehicle", vehicle: id })}
            >
              {id === "" ? t("tour.any") : words.vehicle(id)}
            </button>
          ))}
        </div>
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
      <div className="tourwork">
        <ol className="tourlist">
          {state.steps.map((step, i) => (
            <TourRow
              key={step.id}
              step={step}
              index={i + 1}
              last={i === state.steps.length - 1}
              only={state.steps.length === 1}
              active={step.id === active.id}
              place={plant?.stations.find((s) => String(s.number) === step.station)?.name ?? ""}
              fault={wrong.find((f) => f.id === step.id)}
              preview={data?.steps[i]}
              onActive={() => setActive(step.id)}
              dispatch={dispatch}
            />
          ))}
          <li className="more">
            <Button
              icon="plus"
              onPress={() => {
                setActive(state.nextId);
                dispatch({ kind: "add" });
              }}
            >
              {t("tour.add")}
            </Button>
          </li>
        </ol>
        <NumberPad
          label={t("tour.pad")}
          digits={active.station}
          onDigits={(station) => dispatch({ kind: "station", id: active.id, station })}
        />
      </div>
      {plant && data && (
        <div className="tourmap">
          <MapView
            plant={plant}
            overlays={{ areas }}
            {...(about.length > 0 && { about })}
            selected={data.vehicle || undefined}
            label={t("tour.map")}
          />
        </div>
      )}
      <div className="row tourfoot">
        <p className={problem ? "lab bad grow" : "lab grow"} role="status">
          {problem ??
            (time !== undefined
              ? t("tour.time", { time: duration(time) })
              : preview.kind === "loading"
                ? t("tour.asking")
                : "")}
        </p>
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
}
