import { useMemo, useState } from "react";
import { useTranslation } from "react-i18next";
import { useLive, usePlant, useStations } from "@/shared/live";
import { useLocation } from "@/shared/router";
import { Card, PanelEmpty, PanelLoading } from "@/shared/ui";
import { StationFilters } from "./StationFilters";
import { lookOf, type StationLook } from "./stationLook";
import { foundStations, zoneOf } from "./stationSearch";
import { StationTile } from "./StationTile";
import { useLastStops } from "./useLastStops";
import "./StationsPage.css";

/** Station board: what stands where, whether it is ready, and how far off the last stop was. */
export function StationsPage() {
  const { t } = useTranslation("stations");
  const live = useStations();
  const ready = useLive((s) => s.ready);
  const plant = usePlant();
  const areas = plant.data?.areas;
  const stations = useMemo(() => live.map((s) => ({ ...s, zone: zoneOf(s, areas ?? []) })), [live, areas]);
  const { query } = useLocation();
  const [find, setFind] = useState(query.get("find") ?? "");
  const [look, setLook] = useState<StationLook>();
  const lastOf = useLastStops(stations);
  const count = (one: StationLook) => stations.filter((s) => lookOf(s.state) === one).length;
  const shown = foundStations(stations, find).filter((s) => look === undefined || lookOf(s.state) === look);
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
          <StationFilters
            find={find}
            onFind={setFind}
            look={look}
            onLook={setLook}
            count={(one) => (one === undefined ? stations.length : count(one))}
            shown={shown.map((s) => s.number)}
          />
          <div className="scroll" tabIndex={0} role="group" aria-label={t("title")}>
            {shown.length === 0 ? (
              <PanelEmpty what={t("none_fits")} when={t("none_fits_hint")} />
            ) : (
              <ul className="board">
                {shown.map((station) => (
                  <StationTile key={station.id} station={station} last={lastOf(station)} />
                ))}
              </ul>
            )}
          </div>
        </>
      )}
    </Card>
  );
}
