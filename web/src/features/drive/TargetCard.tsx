import { useState, useSyncExternalStore } from "react";
import { useTranslation } from "react-i18next";
import type { Plant, Vehicle } from "@/shared/api/types";
import { liveStore } from "@/shared/live";
import { Card, PanelEmpty } from "@/shared/ui";
import { degrees, length, millimetres } from "@/shared/words/format";
import { nearest, type Way } from "./target";
import "./TargetCard.css";

const kOffered = 3;
const kFar_m = 10;
const posesChange = (listener: () => void) => liveStore.subscribePoses(listener);

/** How far it has still to go to a station near by, as whoever drives it sees it. */
export function TargetCard({ vehicle, plant }: { vehicle: Vehicle; plant: Plant }) {
  const { t } = useTranslation("drive");
  const streamed = useSyncExternalStore(posesChange, () => liveStore.poses.get(vehicle.id));
  const pose = streamed ?? vehicle.pose; // at half a second a creeping vehicle would jump by a centimetre
  const [chosen, setChosen] = useState<string>();
  const near =
    pose === undefined || vehicle.hall === undefined || !vehicle.pose_known
      ? []
      : nearest(plant, vehicle.hall, vehicle.type, pose, kOffered);
  const way = near.find((one) => one.station.id === chosen) ?? near[0];
  if (way === undefined) {
    return (
      <Card title={t("target.title")}>
        <PanelEmpty what={t("target.unknown")} when={t("target.unknown_hint")} />
      </Card>
    );
  }
  return (
    <Card
      className="target"
      title={t("target.to", { number: way.station.number })}
      summary={way.station.name}
      right={t("target.away", { length: length(way.distance_m) })}
    >
      <div className="seg" role="group" aria-label={t("target.which")}>
        {near.map((one) => (
          <button
            key={one.station.id}
            type="button"
            aria-pressed={one.station.id === way.station.id}
            onClick={() => setChosen(one.station.id)}
          >
            {t("target.station", { number: one.station.number })}
          </button>
        ))}
      </div>
      <dl className="ways3">
        {rows(way).map(({ key, value, unit, inside }) => (
          <div key={key} className={inside ? "in" : ""}>
            <dt className="cap">{t(`target.${key}`)}</dt>
            <dd className="val lg">
              <b>{value}</b>
              <u>{unit}</u>
            </dd>
            <dd className="cap">{inside ? t("target.inside") : "\u00a0"}</dd>
          </div>
        ))}
      </dl>
    </Card>
  );
}

interface Row {
  key: string;
  value: string;
  unit: string;
  inside: boolean;
}

/** Each as the direction that brings it there, and whether that is inside the station's tolerance. */
function rows({ station, ahead_m, left_m, turn_rad }: Way): Row[] {
  const { dx_m, dy_m, dheading_rad } = station.tolerance;
  const most_m = Math.min(dx_m, dy_m);
  const distance = (value_m: number) =>
    Math.abs(value_m) < kFar_m
      ? { value: millimetres(Math.abs(value_m)), unit: "mm" }
      : { value: Math.abs(value_m).toFixed(1), unit: "m" };
  return [
    { key: ahead_m < 0 ? "back" : "ahead", ...distance(ahead_m), inside: Math.abs(ahead_m) <= most_m },
    { key: left_m < 0 ? "right" : "left", ...distance(left_m), inside: Math.abs(left_m) <= most_m },
    {
      key: turn_rad < 0 ? "turn_right" : "turn_left",
      value: degrees(Math.abs(turn_rad), { decimals: 2 }),
      unit: "°",
      inside: Math.abs(turn_rad) <= dheading_rad,
    },
  ];
}
