import { useCallback, useState } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { Vehicle } from "@/shared/api/types";
import { CommandFailed } from "@/shared/commands";
import { CommandButton } from "@/shared/ui";
import { useCommand, useProgress } from "@/shared/ui/useCommand";
import { canApply, holdsFloor, levels, type Level } from "./integration";
import "@/shared/ui/folded.css";

/** How far a vehicle takes part; takes it out and in again. */
export function IntegrationCard({ vehicle, refused }: { vehicle: Vehicle; refused: string | undefined }) {
  const { t } = useTranslation("vehicles");
  const [wanted, setWanted] = useState<Level>(vehicle.integration);
  const [offFloor, setOffFloor] = useState(false);
  const command = useCommand(
    useCallback(
      () =>
        call(
          api.PUT("/api/v1/vehicles/{id}/integration", {
            params: { path: { id: vehicle.id } },
            body: { level: wanted, off_floor: offFloor },
          }),
        ),
      [vehicle.id, wanted, offFloor],
    ),
  );
  const leaves = holdsFloor(vehicle.integration) && !holdsFloor(wanted);
  const progress = useProgress(command, vehicle.integration === wanted, vehicle.name);
  const may = canApply(vehicle.integration, wanted, offFloor);
  return (
    <details className="card integ" open={vehicle.integration !== "utilise"}>
      <summary>
        <b>{t("integration.title")}</b>
        <span className="lab">{t(`integration.now.${vehicle.integration}`)}</span>
      </summary>
      <div className="seg" role="group" aria-label={t("integration.title")}>
        {levels.map((level) => (
          <button key={level} type="button" aria-pressed={wanted === level} onClick={() => setWanted(level)}>
            {t(`integration.level.${level}`)}
          </button>
        ))}
      </div>
      <p className="lab">{t(`integration.means.${wanted}`)}</p>
      {leaves && (
        <label className="row out">
          <input type="checkbox" checked={offFloor} onChange={(event) => setOffFloor(event.target.checked)} />
          <span>{t("integration.off_floor", { vehicle: vehicle.name })}</span>
        </label>
      )}
      <CommandButton
        label={t("integration.apply")}
        primary={false}
        progress={progress}
        disabledReason={refused ?? (may === "yes" ? undefined : t(`integration.${may}`))}
        onRun={command.run}
      />
      <CommandFailed command={command} />
    </details>
  );
}
