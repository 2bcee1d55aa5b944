import { useState } from "react";
import { useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import {
  useLive,
  useMayCommand,
  usePlant,
  useStations,
  useVehicle,
  useServerNow,
  type LiveStation,
} from "@/shared/live";
import { Link } from "@/shared/router";
import { Card, PanelEmpty, PanelLoading, StatusSymbol } from "@/shared/ui";
import { dateTime, degrees, millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import type { LastStop } from "./lastStops";
import { comingTo, lookOf, looks, lookSymbol, type StationLook } from "./stationLook";
import { useLastStops } from "./useLastStops";
import "./stations.css";

/** Station board: what stands where, whether it is ready, and how far off the last stop was. */
export function StationsPage() {
  const { t } = useTranslation("stations");
  const stations = useStations();
  const ready = useLive((s) => s.ready);
  const plant = usePlant();
  const [filter, setFilter] = useState<StationLook>();
  const lastOf = useLastStops(stations);
  const count = (look: StationLook) => stations.filter((s) => lookOf(s.state) === look).length;
  const shown = stations.filter((s) => filter === undefined || lookOf(s.state) === filter);
  return (
    <Card
      className="listpage"
      level={1}
      title={t("title")}
      summary={t("summary", {
        ready: count("ready"),
        occupied: count("ready") + count("occupied"),
        total: stations.length,
      })}
      flush
    >
      {!ready || plant.isPending ? (
        <PanelLoading what={t("title")} />
      ) : stations.length === 0 ? (
        <PanelEmpty what={t("empty")} when={t("empty_hint")} />
      ) : (
        <>
          <div className="sfilter">
            <div className="seg" role="group" aria-label={t("filter")}>
              <button type="button" aria-pressed={filter === undefined} onClick={() => setFilter(undefined)}>
                {t("filter_all")} {stations.length}
              </button>
              {looks.map((look) => (
                <button
                  key={look}
                  type="button"
                  aria-pressed={filter === look}
                  onClick={() => setFilter(look)}
                >
                  {t(`state.${look}`)} {count(look)}
                </button>
              ))}
            </div>
            {shown.length > 0 && <PrintCodes stations={shown.map((s) => s.number)} />}
          </div>
          <div className="scroll" tabIndex={0} role="group" aria-label={t("title")}>
            {shown.length === 0 && <PanelEmpty what={t("none_fits")} />}
            <ul className="board" hidden={shown.length === 0}>
              {shown.map((station) => (
                <Tile key={station.id} station={station} last={lastOf(station)} />
              ))}
            </ul>
          </div>
        </>
      )}
    </Card>
  );
}

/** True-scale sheets of the floor codes of the stations shown, to print, cut and lay. */
function PrintCodes({ stations }: { stations: number[] }) {
  const { t } = useTranslation("stations");
  return (
    <div className="row print" role="group" aria-label={t("print")}>
      <span>{t("print")}</span>
      {(["pdf", "svg", "csv"] as const).map((format) => (
        <a
          key={format}
          className="btn"
          href={`/api/v1/marker-sheets?stations=${stations.join(",")}&format=${format}`}
          download
        >
          {t(`print_${format}`)}
        </a>
      ))}
    </div>
  );
}

function Tile({ station, last }: { station: LiveStation; last: LastStop }) {
  const { t } = useTranslation("stations");
  const words = useWords();
  const mayCommand = useMayCommand();
  const now = useServerNow(60_000);
  const stop = last.kind === "known" ? last.stop : undefined;
  const look = lookOf(station.state);
  const by = station.state?.occupied_by || undefined;
  const vehicle = useVehicle(by);
  const symbol = lookSymbol[look];
  const free = look === "free" || look === "reserved";
  return (
    <li className={`tile ${look}`}>
      <header>
        <b className="num">{station.number}</b>
        <div className="grow">
          <strong>{station.name}</strong>
          <span className="row st">
            {symbol && <StatusSymbol name={symbol} />}
            {t(`state.${look}`)}
            {look === "occupied" && t("because", { why: t("not_measured") })}
          </span>
        </div>
      </header>
      <p className="lab">{who()}</p>
      {stop ? (
        <Last stop={stop} time={dateTime(stop.at, now)} />
      ) : (
        <p className="cap nostop">{t(`no_stop.${last.kind}`)}</p>
      )}
      <div className="row acts">
        {mayCommand && free && (
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
    </li>
  );

  function who(): string {
    const coming = comingTo(station.state);
    if (by) {
      const name = words.vehicle(by);
      const here = vehicle?.load_name ? t("carries", { vehicle: name, load: vehicle.load_name }) : name;
      return coming ? t("then", { here, vehicle: words.vehicle(coming) }) : here;
    }
    if (coming) return t("reserved_for", { vehicle: words.vehicle(coming) });
    return station.resting_place ? t("resting") : "\u00a0";
  }
}

/** The last stop as two small bands: distance and heading against the tolerance. */
function Last({ stop, time }: { stop: StopRecord; time: string }) {
  const { t } = useTranslation("stations");
  const limit = Math.min(stop.tolerance.dx_m, stop.tolerance.dy_m);
  const most = Math.max(Math.abs(stop.dx_m), Math.abs(stop.dy_m));
  return (
    <div className="laststop">
      <span className="cap">
        {t("last_stop")} {time}
      </span>
      <div className="row">
        <StatusSymbol name={stop.inside ? "c-ok" : "a-2"} size={16} />
        <b>
          {millimetres(stop.dx_m, { decimals: 1, sign: true })},{" "}
          {millimetres(stop.dy_m, { decimals: 1, sign: true })} mm
        </b>
        <b>{degrees(stop.dheading_rad, { sign: true })}°</b>
      </div>
      <Band share={most / limit} />
      <Band share={Math.abs(stop.dheading_rad) / stop.tolerance.dheading_rad} />
    </div>
  );
}

function Band({ share }: { share: number }) {
  const x = Math.min(1.2, share) * 83.3;
  return (
    <svg viewBox="0 0 100 8" preserveAspectRatio="none" aria-hidden="true">
      <rect width="100" height="4" y="2" fill="var(--surface-3)" />
      <rect width="83.3" height="6" y="1" fill="var(--band)" />
      <rect x={Math.max(0, x - 0.6)} width="1.2" height="8" fill="var(--needle)" />
    </svg>
  );
}
