import { useCallback, useEffect, useMemo, useRef, useState } from "react";
import { useTranslation } from "react-i18next";
import type { Closure } from "@/shared/api/types";
import { useClosures, useMayCommand, usePlant, useVehicle, useVehicles } from "@/shared/live";
import {
  closurePlace,
  hallModel,
  MapControls,
  MapView,
  type MapHandle,
  type MapOverlays,
  type Picked,
} from "@/shared/map";
import { Link, navigate, useLocation } from "@/shared/router";
import { Icon, PanelFailed, PanelLoading } from "@/shared/ui";
import { useNarrow } from "@/shared/ui/useNarrow";
import { FloorPanel } from "./FloorPanel";
import { emptyFloor, outlineOf, pressed } from "./floorTool";
import { Legend } from "./Legend";
import "./MapPage.css";
import "./map-tools.css";
import { OrderStrip } from "./OrderStrip";
import { PlacePanel } from "./PlacePanel";
import { emptyPlace, placePressed } from "./placeTool";
import { VehicleCard } from "./VehicleCard";
import { VehicleList } from "./VehicleList";

const kNoOverlays: MapOverlays = {};

/** The hall with all that moves, beside it the same in words. */
export function MapPage() {
  const { t } = useTranslation("map");
  const plant = usePlant();
  const { query } = useLocation();
  const map = useRef<MapHandle>(null);
  const selected = query.get("vehicle") ?? undefined;
  const shown = useVehicle(selected);
  const count = useVehicles().length;
  const narrow = useNarrow();
  const [listed, setListed] = useState(false);
  const [fromList, setFromList] = useState(false);
  const closed = useRef<string>(undefined);
  const [following, setFollowing] = useState(false);
  const [find, setFind] = useState("");
  const [station, setStation] = useState<string>();
  const placing = useVehicle(query.get("place") ?? undefined);
  const tool = placing ? "place" : query.has("floor") ? "floor" : undefined;
  const [floor, setFloor] = useState(emptyFloor);
  const [place, setPlace] = useState(emptyPlace);
  const closures = useClosures();
  const mayCommand = useMayCommand();
  const model = useMemo(() => plant.data && hallModel(plant.data), [plant.data]);

  useEffect(() => {
    setFloor(emptyFloor);
    setPlace(emptyPlace);
  }, [tool, placing?.id]);
  useEffect(() => {
    if (selected === undefined) setFollowing(false);
  }, [selected]);

  // The keyboard goes back to the row of the vehicle whose card was closed.
  useEffect(() => {
    if (selected !== undefined || closed.current === undefined) return;
    const row = document.querySelector<HTMLElement>(`[data-vehicle="${CSS.escape(closed.current)}"]`);
    closed.current = undefined;
    (row ?? document.querySelector<HTMLElement>("canvas.canvas"))?.focus({ preventScroll: true });
  }, [selected]);

  const numbers = useMemo(
    () => new Map((plant.data?.stations ?? []).map((s) => [s.id, String(s.number)])),
    [plant.data],
  );
  const numberOf = useCallback((id: string) => numbers.get(id), [numbers]);
  const select = (vehicle: string | undefined, inList = false) => {
    setFromList(inList);
    navigate(vehicle === undefined ? "/map" : `/map?vehicle=${encodeURIComponent(vehicle)}`, {
      replace: true,
    });
  };
  const pick = (picked: Picked) => {
    if (tool === "floor" && picked.kind === "point" && model) {
      setFloor((draft) => pressed(draft, model.lanes, picked.point, picked.reach_m));
      return;
    }
    if (tool === "place" && placing && plant.data) {
      const { data } = plant;
      setPlace((draft) => placePressed(draft, picked, data, placing.pose?.heading_rad ?? 0));
      return;
    }
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

  const showClosure = (closure: Closure) => {
    const at = model && closurePlace(model, closure);
    if (at !== undefined) map.current?.show(closure.outline ?? [at], 12);
  };
  const openTool = (what: string) => navigate(`/map?${what}`, { replace: true });
  const closeTool = () => select(tool === "place" ? placing?.id : undefined);

  if (plant.data === undefined || model === undefined) {
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
  const overlays: MapOverlays =
    tool === "floor"
      ? {
          closing: {
            edges: [...floor.edges],
            ...(floor.area && { outline: outlineOf(floor.area) }),
            ...(floor.corner && { corner: floor.corner }),
          },
        }
      : tool === "place" && placing && place.pose
        ? { ghost: { pose: place.pose, type: placing.type } }
        : station !== undefined
          ? { target: station }
          : kNoOverlays;
  const card = tool === undefined && shown !== undefined;
  // On a tablet what is worked with stands beside the map; else the list is docked under it.
  const beside = tool !== undefined || card || (narrow && listed);
  return (
    <div className={`mappage ${beside ? "tooled" : ""} ${card ? "carded" : ""}`}>
      <section className="left" aria-label={t("title")}>
        <h1 className="unseen">{t("title")}</h1>
        <MapView
          ref={map}
          plant={plant.data}
          selected={placing?.id ?? selected}
          prefer={tool === "floor" ? "point" : tool === "place" ? "station" : "vehicle"}
          follow={following ? selected : undefined}
          onFollowEnd={() => setFollowing(false)}
          onPick={pick}
          overlays={overlays}
        />
        <Legend plant={plant.data}>
          {(mayCommand || closures.length > 0) && (
            <button
              type="button"
              className="btn floorbtn"
              aria-pressed={tool === "floor"}
              onClick={() => (tool === "floor" ? closeTool() : openTool("floor"))}
            >
              <Icon name="x" />
              <span>
                {closures.length > 0 ? t("floor.tool_closed", { count: closures.length }) : t("floor.tool")}
              </span>
            </button>
          )}
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
        {tool === "floor" ? (
          <FloorPanel
            model={model}
            draft={floor}
            onDraft={setFloor}
            onShow={showClosure}
            onClose={closeTool}
          />
        ) : tool === "place" && placing ? (
          <PlacePanel vehicle={placing} draft={place} onDraft={setPlace} onClose={closeTool} />
        ) : (
          <>
            <VehicleList
              find={find}
              onFind={setFind}
              selected={selected}
              onSelect={(id) => select(id === selected ? undefined : id, true)}
              station={station}
              onStation={showStation}
            />
            {card ? (
              <VehicleCard
                vehicle={shown}
                numberOf={numberOf}
                takesFocus={fromList}
                onSelect={(id) => select(id, true)}
                onClose={() => {
                  closed.current = shown.id;
                  select(undefined);
                }}
              />
            ) : (
              <div className="cta">
                <button
                  type="button"
                  className="btn lt-sm allbtn"
                  aria-pressed={listed}
                  onClick={() => setListed((on) => !on)}
                >
                  {listed ? t("list.urgent") : t("list.all", { count })}
                </button>
                <Link className="btn primary motion" to="/send">
                  <Icon name="send" />
                  <span>{t("send")}</span>
                </Link>
              </div>
            )}
          </>
        )}
      </aside>
    </div>
  );
}
