import { useTranslation } from "react-i18next";
import type { MotionMode, Vehicle } from "@/shared/api/types";
import { useLive } from "@/shared/live";
import { number } from "@/shared/words/format";
import { startsAt } from "../busy/busy";
import { PreviewMap } from "./PreviewMap";
import { isLoaded } from "./previewOverlays";
import { Measures } from "./PreviewPanel";
import type { Send } from "../useSend";
import "./PreviewCard.css";

const kNone: readonly never[] = [];

export interface PreviewCardProps {
  send: Send;
  /** The move that is watched instead of a preview: its vehicle, and the station it goes to. */
  watched: { vehicle: Vehicle | undefined; station: number | undefined } | undefined;
  looked: MotionMode | undefined;
  picking: boolean;
  onPick: (station: number) => void;
}

/** Step 5: the move on the map with its figures, or the one under way. */
export function PreviewCard({ send, watched, looked, picking, onPick }: PreviewCardProps) {
  const { t } = useTranslation("send");
  const streamReady = useLive((s) => s.ready);
  const { plant, vehicle, station, option, step, busy } = send;
  const from = busy && step ? step.start : undefined;
  const at = startsAt(from, plant);
  return (
    <section className="card c3" aria-label={t("preview.title")}>
      <header className="stp">
        {!watched && <i aria-hidden="true">5</i>}
        <h2>{t(watched ? "move.map" : "preview.title")}</h2>
        {!watched && option?.swept_area_m2 !== undefined && (
          <span className="ans r">
            {t(isLoaded(vehicle) ? "preview.swept" : "preview.swept_bare", {
              area: number(option.swept_area_m2),
            })}
          </span>
        )}
      </header>
      {!watched && busy && from && (
        <p className="from" role="note">
          {at === undefined
            ? t("preview.from_here", { vehicle: vehicle?.name })
            : t("preview.from", { vehicle: vehicle?.name, number: at, order: busy.order.name })}
        </p>
      )}
      {plant && streamReady ? (
        <PreviewMap
          plant={plant}
          vehicle={watched ? watched.vehicle : vehicle}
          station={watched ? plant.stations.find((s) => s.number === watched.station) : station}
          option={watched ? undefined : option}
          options={watched ? kNone : send.leadThere}
          looked={looked}
          leg={watched?.vehicle?.leg}
          from={watched ? undefined : from}
          picking={(picking || !station) && !watched}
          onPick={onPick}
        />
      ) : (
        <p className="lab pad-top">{t("preview.wait")}</p>
      )}
      {!watched && <Measures option={option} step={step} station={station} plant={plant} />}
    </section>
  );
}
