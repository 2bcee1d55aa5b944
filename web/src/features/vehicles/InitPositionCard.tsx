import { useCallback, useState } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { Plant, Pose, Vehicle } from "@/shared/api/types";
import { CommandFailed } from "@/shared/commands";
import { Card, CommandButton } from "@/shared/ui";
import { useCommand, useProgress } from "@/shared/ui/useCommand";
import { draftOf, emptyDraft, readDraft, type InitDraft } from "./initPosition";
import "./InitPositionCard.css";

/** A person says where a vehicle stands that lost its position, or says one that cannot be. Nothing moves by it. */
export function InitPositionCard({
  vehicle,
  plant,
  refused,
}: {
  vehicle: Vehicle;
  plant: Plant | undefined;
  /** Why commands are off. */
  refused: string | undefined;
}) {
  const { t } = useTranslation("vehicles");
  const [draft, setDraft] = useState<InitDraft>(emptyDraft);
  const result = readDraft(draft, plant);
  const pose = result.kind === "pose" ? result.pose : undefined;
  const command = useCommand(
    useCallback(
      () =>
        pose === undefined
          ? Promise.resolve()
          : call(
              api.POST("/api/v1/vehicles/{id}/init-position", {
                params: { path: { id: vehicle.id } },
                body: pose,
              }),
            ),
      [vehicle.id, pose],
    ),
  );
  const progress = useProgress(command, vehicle.pose_known, vehicle.name);
  const set = (change: Partial<InitDraft>) => setDraft((d) => ({ ...d, ...change }));
  return (
    <Card className="init" title={t("init.title", { vehicle: vehicle.name })} summary={t("init.hint")}>
      <div className="seg how" role="group" aria-label={t("init.how")}>
        <button type="button" aria-pressed={draft.how === "station"} onClick={() => set({ how: "station" })}>
          {t("init.at_station")}
        </button>
        <button type="button" aria-pressed={draft.how === "numbers"} onClick={() => set({ how: "numbers" })}>
          {t("init.by_numbers")}
        </button>
      </div>
      {vehicle.claimed_pose && (
        <div className="seg how" role="group" aria-label={t("init.doubt")}>
          {vehicle.pose && known(t("init.where_it_was"), vehicle.pose)}
          {known(t("init.where_it_says"), vehicle.claimed_pose)}
        </div>
      )}
      <div className="fields">
        {draft.how === "station" ? (
          <Field label={t("init.station")} value={draft.station} onChange={(station) => set({ station })} />
        ) : (
          <>
            <Field label={t("init.x")} value={draft.x_mm} onChange={(x_mm) => set({ x_mm })} />
            <Field label={t("init.y")} value={draft.y_mm} onChange={(y_mm) => set({ y_mm })} />
            <Field
              label={t("init.heading")}
              value={draft.heading_deg}
              onChange={(heading_deg) => set({ heading_deg })}
            />
            <div className="seg known" role="group" aria-label={t("init.known")}>
              <button type="button" aria-pressed={!draft.measured} onClick={() => set({ measured: false })}>
                {t("init.by_eye")}
              </button>
              <button type="button" aria-pressed={draft.measured} onClick={() => set({ measured: true })}>
                {t("init.measured")}
              </button>
            </div>
          </>
        )}
        <CommandButton
          label={t("init.set")}
          primary={false}
          progress={progress}
          disabledReason={refused ?? fault()}
          onRun={command.run}
        />
      </div>
      <CommandFailed command={command} />
    </Card>
  );

  function known(label: string, pose: Pose) {
    return (
      <button type="button" onClick={() => setDraft(draftOf(pose))}>
        {label}
      </button>
    );
  }

  function fault(): string | undefined {
    switch (result.kind) {
      case "pose":
        return undefined;
      case "empty":
        return t("init.empty");
      case "bad_station":
        return t("init.bad_station", { number: result.number });
      case "bad_number":
        return t("init.bad_number", { field: t(`init.${result.field}`) });
      case "bad_heading":
        return t("init.bad_heading");
    }
  }
}

function Field({
  label,
  value,
  onChange,
}: {
  label: string;
  value: string;
  onChange: (value: string) => void;
}) {
  return (
    <label className="field">
      <span className="cap">{label}</span>
      <input
        type="text"
        inputMode="decimal"
        value={value}
        onChange={(event) => onChange(event.target.value)}
      />
    </label>
  );
}
