import { useRef, useState } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import { fleetHalt, useCommandsEnabled, useFleet, useMayCommand, useVehicles } from "@/shared/live";
import { goGuard, Icon } from "@/shared/ui";
import "./PauseFleet.css";

/**
 * Always the top right corner. One press, no dialog, and it can never let anything go: while the fleet is
 * paused it says how far that has come. Resume has its own place, in the banner.
 */
export function PauseFleet() {
  const { t } = useTranslation();
  const enabled = useCommandsEnabled();
  const may = useMayCommand();
  const halt = fleetHalt(useFleet(), useVehicles());
  const [state, setState] = useState<"ready" | "sent" | "failed">("ready");
  const busy = useRef(false);
  const paused = halt?.all === true;
  const possible = enabled && may;

  const pause = async () => {
    goGuard.stopPressed(performance.now());
    if (!possible || paused || busy.current) return;
    busy.current = true;
    setState("sent");
    try {
      await call(api.POST("/api/v1/fleet/pause"));
      setState("ready");
    } catch {
      setState("failed");
    } finally {
      busy.current = false;
    }
  };

  const title =
    paused && halt.moving > 0
      ? t("pause.stopping")
      : paused
        ? t("pause.paused")
        : state === "sent"
          ? t("pause.pausing")
          : t("pause.pause");
  return (
    <button
      type="button"
      className="pause"
      aria-disabled={!possible || paused}
      data-paused={paused}
      data-moving={halt?.moving}
      onClick={() => void pause()}
    >
      <Icon name="pause" />
      <span role="status">
        <strong>{title}</strong>
        <small>{small()}</small>
      </span>
    </button>
  );

  function small(): string {
    if (!may) return t("pause.viewer");
    if (!enabled) return t("pause.offline");
    if (state === "failed" && !paused) return t("pause.failed");
    if (halt === undefined) return t("pause.not_e_stop");
    const { moving, unheard, total, held } = halt;
    if (!paused) return t("pause.some", { held, total });
    if (moving > 0) return t("pause.moving", { moving, total });
    return unheard > 0 ? t("pause.unheard", { unheard, total }) : t("pause.stand", { total });
  }
}
