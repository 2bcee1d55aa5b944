import type { ReactNode } from "react";
import { Trans, useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import { LoadLink } from "@/shared/body/LoadLink";
import { useMayCommand, useServerNow, useVehicle, type LiveStation } from "@/shared/live";
import { Link } from "@/shared/router";
import { StatusSymbol } from "@/shared/ui";
import { dateTime } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { LastStopBands } from "./LastStopBands";
import type { LastStop } from "./lastStops";
import { comingTo, lookOf, lookSymbol, type StationLook } from "./stationLook";
import "./StationTile.css";

export interface StationTileProps {
  station: LiveStation & { zone: string };
  last: LastStop;
}

/** One station: what it is, who stands there or comes, its last stop, and what can be done there. */
export function StationTile({ station, last }: StationTileProps) {
  const { t } = useTranslation("stations");
  const now = useServerNow(60_000);
  const stop = last.kind === "known" ? last.stop : undefined;
  const look = lookOf(station.state);
  const symbol = lookSymbol[look];
  return (
    <li className={`tile ${look}`}>
      <header>
        <b className="num">{station.number}</b>
        <div className="grow">
          <strong>{station.name}</strong>
          {station.zone !== "" && <span className="cap zone-name">{station.zone}</span>}
          <span className="row st">
            {symbol && <StatusSymbol name={symbol} />}
            {t(`state.${look}`)}
            {look === "occupied" && t("because", { why: t("not_measured") })}
          </span>
        </div>
      </header>
      <p className="lab">{useWho(station)}</p>
      {stop ? (
        <LastStopBands stop={stop} time={dateTime(stop.at, now)} />
      ) : (
        <p className="cap nostop">{t(`no_stop.${last.kind}`)}</p>
      )}
      <Acts station={station} look={look} stop={stop} />
    </li>
  );
}

/** Who stands at a station, what is there, and who is on its way there. */
function useWho(station: LiveStation): ReactNode {
  const { t } = useTranslation("stations");
  const words = useWords();
  const by = station.state?.occupied_by || undefined;
  const carried = useVehicle(by)?.load;
  const coming = comingTo(station.state);
  const held = station.state?.load;
  const withLoad = (key: "holds" | "carries", id: string, vehicle: string) => (
    <Trans
      t={t}
      i18nKey={key}
      values={{ load: words.load(id), vehicle }}
      components={{ load: <LoadLink id={id} /> }}
    />
  );
  if (held !== undefined && !by) return withLoad("holds", held, "");
  if (by) {
    const name = words.vehicle(by);
    return (
      <>
        {carried === undefined ? name : withLoad("carries", carried, name)}
        {coming && t("then", { vehicle: words.vehicle(coming) })}
      </>
    );
  }
  if (coming) return t("reserved_for", { vehicle: words.vehicle(coming) });
  return station.resting_place ? t("resting") : "\u00a0";
}

function Acts({
  station,
  look,
  stop,
}: {
  station: LiveStation;
  look: StationLook;
  stop: StopRecord | undefined;
}) {
  const { t } = useTranslation("stations");
  const mayCommand = useMayCommand();
  return (
    <div className="row acts">
      {mayCommand && (look === "free" || look === "reserved") && (
        <Link className="btn" to={`/send?station=${station.number}`}>
          {t("send")}
        </Link>
      )}
      {stop && (
        <Link className="btn quiet" to={`/records/${stop.id}`}>
          {t("record")}
        </Link>
      )}
      <Link className="btn quiet" to={`/records?station=${station.number}`}>
        {t("records")}
      </Link>
      <a
        className="btn quiet"
        href={`/api/v1/marker-sheets?stations=${station.number}&format=pdf`}
        download
        aria-label={t("print_one", { number: station.number })}
      >
        {t("print_codes")}
      </a>
    </div>
  );
}
