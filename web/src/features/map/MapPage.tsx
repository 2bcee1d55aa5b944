import { useEffect, useRef, useState } from "react";
import { useTranslation } from "react-i18next";
import { usePlant } from "@/shared/live";
import { MapControls, MapView, type MapHandle, type Picked } from "@/shared/map";
import { Link, navigate, useLocation } from "@/shared/router";
import { Icon, PanelFailed, PanelLoading } from "@/shared/ui";
import { Legend } from "./Legend";
import "./map-page.css";
import { OrderStrip } from "./OrderStrip";
import { VehicleList } from "./VehicleList";

/** The hall with all that moves, beside it the same in words. */
export function MapPage() {
  const { t } = useTranslation("map");
  const plant = usePlant();
  const { query } = useLocation();
  const map = useRef<MapHandle>(null);
  const selected = query.get("vehicle") ?? undefined;
  const [following, setFollowing] = useState(false);
  const [find, setFind] = useState("");
  const [station, setStation] = useState<string>();

  useEffect(() => {
    if (selected === undefined) setFollowing(false);
  }, [selected]);

  const select = (vehicle: string | undefined) =>
    navigate(vehicle === undefined ? "/map" : `/map?vehicle=${encodeURIComponent(vehicle)}`, {
      replace: true,
    });
  const pick = (picked: Picked) => {
    if (picked.kind === "vehicle") select(picked.id === selected ? undefined : picked.id);
    if (picked.kind === "station") setFind(String(picked.number));
    if (picked.kind === "point") {
      select(undefined);
      setFind("");
      setStation(undefined);
    }
  };
  const showStation = (id: string) => {
    setStation(id);
    const pose = plant.data?.stations.find((s) => s.id === id)?.pose;
    if (pose !== undefined) map.current?.show([pose], 12);
  };

  if (plant.data === undefined) {
    return (
      <div className="card">
        {plant.isError ? (
          <PanelFailed what={t("failed")} error={plant.error} onRetry={() => void plant.refetch()} />
        ) : (
          <PanelLoading what={t("loading")} />
        )}
      </div>
    );
  }
  return (
    <div className="mappage">
      <section className="left" aria-label={t("title")}>
        <h1 className="unseen">{t("title")}</h1>
        <MapView
          ref={map}
          plant={plant.data}
          selected={selected}
          follow={following ? selected : undefined}
          onFollowEnd={() => setFollowing(false)}
          onPick={pick}
          {...(station !== undefined && { overlays: { target: station } })}
        />
        <Legend revision={plant.data.revision}>
          <MapControls
            map={map}
            follow={{
              on: following,
              possible: selected !== undefined,
              toggle: () => setFollowing((on) => !on),
            }}
          />
        </Legend>
        <OrderStrip />
      </section>
      <aside className="card side">
        <VehicleList
          find={find}
          onFind={setFind}
          selected={selected}
          onSelect={(id) => select(id === selected ? undefined : id)}
          station={station}
          onStation={showStation}
        />
        <div className="cta">
          <Link
            className="btn primary motion"
            to={selected === undefined ? "/send" : `/send?vehicle=${encodeURIComponent(selected)}`}
          >
            <Icon name="send" />
            <span>{t("send")}</span>
          </Link>
        </div>
      </aside>
    </div>
  );
}
