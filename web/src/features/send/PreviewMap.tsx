import { useMemo, useRef } from "react";
import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { MapControls, MapView, type MapHandle } from "@/shared/map";
import { number } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { AreasLegend } from "./SweptAreas";
import { areasOf, fits, previewOf, type PreviewInput } from "./previewOverlays";
import "./PreviewMap.css";

/** The move on the hall's own map: swept areas, way, where it ends, dimensions. A press takes a station while picking. */
export function PreviewMap(props: PreviewInput & { onPick: (station: number) => void }) {
  const { plant, vehicle, station, option, options, looked, leg, picking, onPick } = props;
  const { t } = useTranslation("send");
  const words = useWords();
  const map = useRef<MapHandle>(null);
  const pose = usePlace(vehicle);
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
          picking,
        },
        {
          metres: (m) => t("preview.metres", { value: number(m, { decimals: 3 }) }),
          degrees: (rad) => `${number((Math.abs(rad) * 180) / Math.PI, { decimals: 1 })}°`,
        },
      ),
    // Of the vehicle only what is drawn: its reports come ten times a second.
    // eslint-disable-next-line react-hooks/exhaustive-deps
    [plant, vehicle?.id, vehicle?.load_kg, pose, station, option, options, looked, leg, picking, t],
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
  const was = last.current.pose;
  const now = vehicle?.pose;
  const same =
    was !== undefined &&
    now !== undefined &&
    Math.hypot(was.x_m - now.x_m, was.y_m - now.y_m) < kMoved_m &&
    Math.abs(was.heading_rad - now.heading_rad) < kTurned_rad;
  if (!same && (was !== undefined || now !== undefined)) last.current = now ? { pose: now } : {};
  return last.current;
}
