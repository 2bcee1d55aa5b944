import { useCallback } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { Vehicle } from "@/shared/api/types";
import { useServerNow } from "@/shared/live";
import { CommandButton } from "@/shared/ui";
import { useCommand, useProgress } from "@/shared/ui/useCommand";
import { CommandFailed } from "./CommandFailed";
import { pauseProgress } from "./pauseProgress";
import { useRefusal } from "./useRefusal";

/** One press has the vehicle stand. The button keeps its place and can never let it go. */
export function PauseVehicle({ vehicle }: { vehicle: Vehicle }) {
  const { t } = useTranslation("commands");
  const refused = useRefusal();
  const now = useServerNow(500);
  const { id } = vehicle;
  const pause = useCommand(
    useCallback(() => call(api.POST("/api/v1/vehicles/{id}/pause", { params: { path: { id } } })), [id]),
  );
  const asked = useProgress(pause, vehicle.paused, vehicle.name);
  return (
    <>
      <CommandFailed command={pause} />
      <CommandButton
        className="pausecmd"
        label={t("pause")}
        icon="pause"
        primary={false}
        twoStep={false}
        direction="stop"
        progress={pauseProgress(vehicle, asked, now, t)}
        disabledReason={refused}
        onRun={pause.run}
      />
    </>
  );
}
