import { useEffect, useMemo, useRef, type ReactNode } from "react";
import { useTranslation } from "react-i18next";
import { kGroups, useLive, useStations, useVehicles, type Group } from "@/shared/live";
import { Link } from "@/shared/router";
import { Icon, StatusSymbol, type SymbolName } from "@/shared/ui";
import { foundStations, grouped } from "./listRows";
import "./VehicleList.css";
import { VehicleRow } from "./VehicleRow";

const kSymbol: Record<Group, SymbolName> = {
  attention: "a-2",
  waiting: "s-wait",
  moving: "s-moving",
  standing: "s-stand",
};

export interface VehicleListProps {
  find: string;
  onFind: (text: string) => void;
  selected: string | undefined;
  onSelect: (vehicle: string) => void;
  onStation: (station: string) => void;
  station: string | undefined;
}

/** The map in words: every vehicle, what it does and why. Also what keyboard and screen reader use. */
export function VehicleList(props: VehicleListProps) {
  const { find, onFind, selected, onSelect } = props;
  const { t } = useTranslation("map");
  const vehicles = useVehicles();
  const stations = useStations();
  const numbers = useMemo(() => new Map(stations.map((s) => [s.id, String(s.number)])), [stations]);
  const names = useMemo(() => new Map(vehicles.map((v) => [v.id, v.name])), [vehicles]);
  const ready = useLive((s) => s.ready);
  const since = useLive((s) => s.since);
  const byId = useLive((s) => s.vehicles);
  const groups = grouped(vehicles, find, since);
  const nobody = vehicles.length > 0 && vehicles.every((v) => v.link === "never");
  const list = useRef<HTMLDivElement>(null);
  // Only the list itself moves: on a phone the page would, away from the map that was pressed.
  useEffect(() => {
    const box = list.current;
    const row = selected && box?.querySelector<HTMLElement>(`[data-vehicle="${CSS.escape(selected)}"]`);
    if (!box || !row) return;
    const [frame, at] = [box.getBoundingClientRect(), row.getBoundingClientRect()];
    if (at.top < frame.top) box.scrollTop -= frame.top - at.top;
    if (at.bottom > frame.bottom) box.scrollTop += at.bottom - frame.bottom;
  }, [selected]);
  const found = foundStations(stations, find);
  const numberOf = (id: string) => numbers.get(id);
  const state = (s: (typeof stations)[number]): ReactNode =>
    s.state?.occupied_by
      ? t("station_occupied", { name: names.get(s.state.occupied_by) ?? s.state.occupied_by })
      : s.state?.reserved_by
        ? t("station_reserved", { name: names.get(s.state.reserved_by) ?? s.state.reserved_by })
        : t("station_free");
  return (
    <>
      <div className="find">
        <Icon name="search" />
        <input
          type="search"
          aria-label={t("find")}
          placeholder={t("find")}
          value={find}
          onChange={(event) => onFind(event.target.value)}
        />
      </div>
      <div className="list" ref={list}>
        {found.map((s) => (
          <div key={s.id} className={`veh stn ${props.station === s.id ? "sel" : ""}`}>
            <Icon name="stations" size={20} />
            <button type="button" className="pickstn" onClick={() => props.onStation(s.id)}>
              <b>{s.number}</b>{" "}
              <span className="what">
                {s.name}, {state(s)}
              </span>
            </button>
            <Link className="btn" to={`/send?station=${s.number}`}>
              {t("send_here")}
            </Link>
          </div>
        ))}
        {ready && groups.length === 0 && found.length === 0 && (
          <p className="lab none">
            {vehicles.length > 0 ? (
              t("not_found")
            ) : (
              <>
                <b>{t("empty")}</b> {t("empty_hint")}
              </>
            )}
          </p>
        )}
        {nobody && <p className="lab none">{t("nobody", { count: vehicles.length })}</p>}
        {kGroups.map((group) => {
          const rows = groups.find((g) => g.group === group)?.vehicles ?? [];
          if (rows.length === 0) return null;
          return (
            <section key={group} className={`g-${group}`} aria-label={t(`group.${group}`)}>
              <div className="grp">
                <StatusSymbol name={kSymbol[group]} />
                <span>{t(`group.${group}`)}</span> <i>{rows.length}</i>
              </div>
              {rows.map((vehicle) => (
                <VehicleRow
                  key={vehicle.id}
                  vehicle={vehicle}
                  vehicles={byId}
                  numberOf={numberOf}
                  selected={vehicle.id === selected}
                  two={group === "attention"}
                  onSelect={() => onSelect(vehicle.id)}
                />
              ))}
            </section>
          );
        })}
      </div>
    </>
  );
}
