import type { RefObject } from "react";
import { useTranslation } from "react-i18next";
import { Icon, type IconName } from "@/shared/ui/Icon";
import type { MapHandle } from "./MapView";

export interface MapControlsProps {
  map: RefObject<MapHandle | null>;
  /** Undefined: no follow button. `possible` needs a selected vehicle. */
  follow?: { on: boolean; possible: boolean; toggle: () => void };
}

/** Zoom, whole hall, follow: for those who do not drag or pinch. */
export function MapControls({ map, follow }: MapControlsProps) {
  const { t } = useTranslation("mapview");
  const button = (icon: IconName, name: string, run: () => void) => (
    <button type="button" aria-label={name} title={name} onClick={run}>
      <Icon name={icon} />
    </button>
  );
  return (
    <div className="mapctl" role="group">
      {follow && (
        <button
          type="button"
          aria-label={t("ctl.follow")}
          title={t("ctl.follow")}
          aria-pressed={follow.on}
          disabled={!follow.possible}
          onClick={follow.toggle}
        >
          <Icon name="follow" />
        </button>
      )}
      {button("plus", t("ctl.zoom_in"), () => map.current?.zoomIn())}
      {button("minus", t("ctl.zoom_out"), () => map.current?.zoomOut())}
      {button("fit", t("ctl.fit"), () => map.current?.fit())}
    </div>
  );
}
