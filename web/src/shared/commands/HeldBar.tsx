import { useCallback } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { Vehicle } from "@/shared/api/types";
import { CommandButton, StatusSymbol } from "@/shared/ui";
import { useCommand, useProgress } from "@/shared/ui/useCommand";
import { CommandFailed } from "./CommandFailed";
import "./HeldBar.css";
import { useHeldWords } from "./useHeldWords";
import { useRefusal } from "./useRefusal";

/** Why a vehicle may not move, by whom and since when, and the way to let it go: at a place of its own. */
export function HeldBar({ vehicle }: { vehicle: Vehicle }) {
  const { t } = useTranslation("commands");
  const refused = useRefusal();
  const held = useHeldWords();
  const { id } = vehicle;
  const resume = useCommand(
    useCallback(() => call(api.POST("/api/v1/fleet/resume", { body: { vehicles: [id] } })), [id]),
  );
  const waits = vehicle.paused || vehicle.needs_resume;
  const progress = useProgress(resume, !waits, vehicle.name);
  if (!waits && progress.kind === "ready") return null;
  return (
    <div className="card held" role="group" aria-label={t("resume")}>
      <CommandButton
        label={t("resume")}
        icon="play"
        primary={false}
        direction="go"
        progress={progress}
        disabledReason={refused}
        onRun={resume.run}
      />
      <span className="grow says" role="status">
        <StatusSymbol name="s-wait" />
        <span>{waits && held(vehicle)}</span>
      </span>
      <CommandFailed command={resume} />
    </div>
  );
}
