import { useCallback, useEffect, useState } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { Vehicle } from "@/shared/api/types";
import { useCommandsEnabled, useMayCommand } from "@/shared/live";
import { Button, CommandButton, Icon, type CommandProgress } from "@/shared/ui";
import { useCommand, type Asked } from "@/shared/ui/useCommand";
import { heading, number } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { kSteps, nudged, standsAt, type Axis, type PlaceDraft } from "./placeTool";

const kConfirmMs = 10_000;
const kAxes: readonly Axis[] = ["east", "north", "heading"];

export interface PlacePanelProps {
  vehicle: Vehicle;
  draft: PlaceDraft;
  onDraft: (draft: PlaceDraft) => void;
  onClose: () => void;
}

/** "It stands elsewhere": a person says where a vehicle stands, on the map and in fine steps. Nothing moves by it. */
export function PlacePanel({ vehicle, draft, onDraft, onClose }: PlacePanelProps) {
  const { t } = useTranslation(["map", "common"]);
  const words = useWords();
  const enabled = useCommandsEnabled();
  const may = useMayCommand();
  const { pose } = draft;
  const { id } = vehicle;
  const { asked, run, reset } = useCommand(
    useCallback(
      () =>
        pose === undefined
          ? Promise.resolve()
          : call(api.POST("/api/v1/vehicles/{id}/init-position", { params: { path: { id } }, body: pose })),
      [id, pose],
    ),
  );
  const taken =
    pose !== undefined && vehicle.pose_known && !vehicle.claimed_pose && standsAt(vehicle.pose, pose);
  const settled = useSettled(asked, taken);
  const progress = ((): CommandProgress => {
    if (asked.kind === "requested") return { kind: "requested", atMs: asked.atMs };
    if (asked.kind !== "stored") return { kind: "ready" };
    if (settled === undefined) return { kind: "accepted", waitingFor: vehicle.name };
    return settled === "late"
      ? { kind: "timed_out", what: t("place.late"), next: t("place.late_next") }
      : { kind: "confirmed", by: vehicle.name, afterS: settled };
  })();
  useEffect(() => reset(), [pose, reset]);
  const shown = pose ?? vehicle.pose;
  const value = (axis: Axis) =>
    shown === undefined
      ? "\u2013"
      : axis === "heading"
        ? `${heading(shown.heading_rad, { decimals: 1 })}\u00b0`
        : `${number(axis === "east" ? shown.x_m : shown.y_m, { decimals: 2 })} m`;
  return (
    <section className="tool" aria-label={t("place.title", { vehicle: vehicle.name })}>
      <header className="row">
        <h2 className="card-title grow">{t("place.title", { vehicle: vehicle.name })}</h2>
        <Button quiet onPress={onClose}>
          {t("place.done")}
        </Button>
      </header>
      <div className="make">
        <p className="lab" role="status">
          {draft.station !== undefined
            ? t("place.at_station", { number: draft.station })
            : t(`place.hint.${pose === undefined ? "none" : draft.next}`)}
        </p>
        <div className="seg names" role="group" aria-label={t("place.step")}>
          {kSteps.map(({ m, deg }, i) => (
            <button
              key={m}
              type="button"
              aria-pressed={draft.step === i}
              onClick={() => onDraft({ ...draft, step: i })}
            >
              {m} m, {deg}°
            </button>
          ))}
        </div>
        <dl className="nudge">
          {kAxes.map((axis) => (
            <div key={axis}>
              <dt className="cap">{t(`place.axis.${axis}`)}</dt>
              <dd>
                <button
                  type="button"
                  className="btn icon"
                  aria-label={t(`place.less.${axis}`)}
                  onClick={() => onDraft(nudged(draft, axis, -1, vehicle.pose))}
                >
                  <Icon name="minus" />
                </button>
                <b>{value(axis)}</b>
                <button
                  type="button"
                  className="btn icon"
                  aria-label={t(`place.more.${axis}`)}
                  onClick={() => onDraft(nudged(draft, axis, 1, vehicle.pose))}
                >
                  <Icon name="plus" />
                </button>
              </dd>
            </div>
          ))}
        </dl>
        <CommandButton
          label={t("place.set")}
          progress={progress}
          disabledReason={
            !may
              ? t("common:pause.viewer")
              : !enabled
                ? t("common:pause.offline")
                : pose === undefined
                  ? t("place.choose")
                  : undefined
          }
          onRun={run}
        />
        {asked.kind === "failed" && (
          <p className="lab bad" role="alert">
            {words.problem(asked.problem)}
          </p>
        )}
      </div>
    </section>
  );
}

/** Seconds after which the vehicle took what was stored; "late" when it has not for long. */
function useSettled(asked: Asked, taken: boolean): number | "late" | undefined {
  const [settled, setSettled] = useState<number | "late">();
  const sinceMs = asked.kind === "stored" ? asked.atMs : undefined;
  useEffect(() => setSettled(undefined), [sinceMs]);
  useEffect(() => {
    if (sinceMs === undefined) return;
    const pastMs = performance.now() - sinceMs;
    if (taken) {
      setSettled((was) => (typeof was === "number" ? was : pastMs / 1000));
      return;
    }
    const timer = setTimeout(() => setSettled((was) => was ?? "late"), Math.max(0, kConfirmMs - pastMs));
    return () => clearTimeout(timer);
  }, [taken, sinceMs]);
  return settled;
}
