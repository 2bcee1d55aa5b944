import { useMemo, useRef } from "react";
import { useTranslation } from "react-i18next";
import type { Pose, Vehicle } from "@/shared/api/types";
import { useVehicle } from "@/shared/live";
import { MapControls, MapView, type MapHandle } from "@/shared/map";
import { number } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { AreasLegend } from "./SweptAreas";
import { areasOf, fits, previewOf, type PreviewInput } from "./previewOverlays";
import "./PreviewMap.css";

/** The move on the hall's own map: swept areas, way, where it ends, dimensions. A press takes a station while picking. */
export function PreviewMap(props: PreviewInput & { onPick: (station: number) => void }) {
  const { plant, vehicle, station, option, options, looked, leg, from, picking, onPick } = props;
  const { t } = useTranslation("send");
  const words = useWords();
  const map = useRef<MapHandle>(null);
  const pose = usePlace(vehicle);
  const nearest = useStill(useVehicle(option?.nearest));
  const { overlays, about } = useMemo(
    () =>
      previewOf(
        {
          plant,
          vehicle: vehicle && { ...vehicle, ...pose },
          station,
          option,
          options,
          looked,
          leg,
          from,
          others: nearest ? [nearest] : [],
          picking,
        },
        {
          metres: (m) => t("preview.metres", { value: number(m, { decimals: 3 }) }),
          degrees: (rad) => `${number((Math.abs(rad) * 180) / Math.PI, { decimals: 1 })}°`,
        },
      ),
    // Of the vehicle only what is drawn: its reports come ten times a second.
    // eslint-disable-next-line react-hooks/exhaustive-deps
    [
      plant,
      vehicle?.id,
      vehicle?.load_kg,
      vehicle?.leg?.id,
      pose,
      nearest,
      station,
      option,
      options,
      looked,
      leg,
      from,
      picking,
      t,
    ],
  );
  const shown = areasOf({ options, option, looked });
  return (
    <div
      className={`pmap ${picking ? "picking" : ""}`}
      data-areas={shown.map((a) => a.mode).join(" ")}
      data-chosen={shown.find((a) => a.look === "chosen")?.mode}
      data-looked={shown.find((a) => a.look === "looked")?.mode}
    >
      <MapView
        ref={map}
        plant={plant}
        {...(vehicle?.hall !== undefined && { hall: vehicle.hall })}
        {...(about && { about })}
        selected={vehicle?.id}
        overlays={overlays}
        prefer="station"
        {...(picking && {
          onPick: (picked) => {
            const found = picked.kind === "station" && plant.stations.find((s) => s.id === picked.id);
            if (found && fits(found, vehicle)) onPick(found.number);
          },
        })}
        label={
          options.length > 0
            ? t("preview.map_modes", {
                modes: options.map((o) => words.mode(o.mode)).join(t("words.join")),
              })
            : t("preview.map")
        }
      />
      <AreasLegend options={options} chosen={option} looked={looked} />
      <MapControls map={map} />
    </div>
  );
}

const kMoved_m = 0.05;
const kTurned_rad = 0.02;

/** The vehicle's pose, the same while it only trembles. */
function usePlace(vehicle: Vehicle | undefined): Pick<Vehicle, "pose"> {
  const last = useRef<Pick<Vehicle, "pose">>({});
  const now = vehicle?.pose;
  if (!isStill(last.current.pose, now)) last.current = now ? { pose: now } : {};
  return last.current;
}

/** A vehicle as it was reported first at its place, while it only trembles there. */
function useStill(vehicle: Vehicle | undefined): Vehicle | undefined {
  const last = useRef<Vehicle>(undefined);
  if (last.current?.id !== vehicle?.id || !isStill(last.current?.pose, vehicle?.pose)) last.current = vehicle;
  return last.current;
}

function isStill(was: Pose | undefined, now: Pose | undefined): boolean {
  if (was === undefined || now === undefined) return was === now;
  const moved = Math.hypot(was.x_m - now.x_m, was.y_m - now.y_m) >= kMoved_m;
  return !moved && Math.abs(was.heading_rad - now.heading_rad) < kTurned_rad;
}
