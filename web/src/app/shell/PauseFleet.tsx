import { useRef, useState } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import { useCommandsEnabled, useMayCommand } from "@/shared/live";
import { Icon } from "@/shared/ui";

/** Always the top right corner. One press, no dialog. While the fleet is paused the same place resumes it. */
export function PauseFleet({ paused, onResume }: { paused: boolean; onResume: () => void }) {
  const { t } = useTranslation();
  const enabled = useCommandsEnabled();
  const may = useMayCommand();
  const [state, setState] = useState<"ready" | "sent" | "failed">("ready");
  const busy = useRef(false);
  const possible = enabled && may;

  const pause = async () => {
    if (!possible || busy.current) return;
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

  const title = paused ? t("pause.resume") : state === "sent" ? t("pause.pausing") : t("pause.pause");
  const small = !may
    ? t("pause.viewer")
    : !enabled
      ? t("pause.offline")
      : paused
        ? t("pause.paused")
        : state === "failed"
          ? t("pause.failed")
          : t("pause.not_e_stop");
  return (
    <button
      type="button"
      className="pause"
      aria-disabled={!possible}
      data-paused={paused}
      onClick={paused ? () => possible && onResume() : () => void pause()}
    >
      <Icon name={paused ? "play" : "pause"} />
      <span role="status">
        <strong>{title}</strong>
        <small>{small}</small>
      </span>
    </button>
  );
}
