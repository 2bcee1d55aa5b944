import { useTranslation } from "react-i18next";
import type { MotionMode, Vehicle } from "@/shared/api/types";
import { useLive } from "@/shared/live";
import { navigate, useLocation } from "@/shared/router";
import { number } from "@/shared/words/format";
import { startsAt } from "../busy/busy";
import { sendAddress } from "../sendAddress";
import type { Send } from "../useSend";
import { BodyView } from "./BodyView";
import { PreviewMap } from "./PreviewMap";
import { isLoaded } from "./previewOverlays";
import { Measures } from "./PreviewPanel";
import { viewNamed, viewsOf, type View } from "./views";
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

/** Step 5: the move on the map with its figures, or the one under way; or what the vehicle says of its body. */
export function PreviewCard(props: PreviewCardProps) {
  const { send, watched, picking } = props;
  const { t } = useTranslation("send");
  const { query } = useLocation();
  const body = watched ? watched.vehicle : send.vehicle;
  const type = send.plant?.vehicle_types.find((one) => one.id === body?.type);
  const views = viewsOf(body, type);
  const view = picking ? "way" : viewNamed(query.get("view"), views);
  const look = (one: View) =>
    navigate(sendAddress({ view: one === "way" ? undefined : one }), { replace: true });
  const title = t(view !== "way" ? `view.${view}` : watched ? "move.map" : "preview.title");
  const swept_m2 = watched ? undefined : send.option?.swept_area_m2;
  return (
    <section className="card c3" aria-label={title}>
      <header className="stp">
        {!watched && view === "way" && <i aria-hidden="true">5</i>}
        <h2>{title}</h2>
        {view === "way" && swept_m2 !== undefined && (
          <span className="ans r">
            {t(isLoaded(send.vehicle) ? "preview.swept" : "preview.swept_bare", { area: number(swept_m2) })}
          </span>
        )}
        {views.length > 1 && (
          <div className="seg viewseg" role="group" aria-label={t("view.label")}>
            {views.map((one) => (
              <button key={one} type="button" aria-pressed={one === view} onClick={() => look(one)}>
                {t(`view.${one}`)}
              </button>
            ))}
          </div>
        )}
      </header>
      {view === "way" || body === undefined ? (
        <Way {...props} />
      ) : (
        <BodyView view={view} vehicle={body} type={type} />
      )}
    </section>
  );
}

function Way({ send, watched, looked, picking, onPick }: PreviewCardProps) {
  const { t } = useTranslation("send");
  const streamReady = useLive((s) => s.ready);
  const { plant, vehicle, station, option, step, busy } = send;
  const from = busy && step ? step.start : undefined;
  const at = startsAt(from, plant);
  return (
    <>
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
    </>
  );
}
