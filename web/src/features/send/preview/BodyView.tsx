import { useTranslation } from "react-i18next";
import type { Vehicle, VehicleType } from "@/shared/api/types";
import { CameraCard } from "@/shared/body/CameraCard";
import { LiftsCard } from "@/shared/body/LiftsCard";
import { LoadsCard } from "@/shared/body/LoadsCard";
import { shownCameras } from "@/shared/body/shownCameras";
import { useRefusal } from "@/shared/commands";
import { stale, useHeard, useLinkLost, useServerNow } from "@/shared/live";
import { kLateS } from "@/shared/ui/Value";
import { useNarrow } from "@/shared/ui/useNarrow";
import type { View } from "./views";
import "./BodyView.css";

/** What the vehicle says of itself beside what it is sent to (Tang 2020, Fig. 12c): loads, wheels, feet, codes. */
export function BodyView({
  view,
  vehicle,
  type,
}: {
  view: Exclude<View, "way">;
  vehicle: Vehicle;
  type: VehicleType | undefined;
}) {
  const { t } = useTranslation("send");
  const narrow = useNarrow();
  const refused = useRefusal();
  const now = useServerNow(500);
  const { heard_s } = useHeard(vehicle);
  const lost = useLinkLost();
  const old = lost || stale(vehicle) || (heard_s ?? Infinity) >= kLateS;
  const cameras = (
    <div className="cams">
      {shownCameras(vehicle, type).map(({ name, camera }) => (
        <CameraCard
          key={name}
          vehicle={vehicle}
          name={name}
          camera={camera}
          type={type?.cameras.find((one) => one.name === name)}
          now={now}
          steps={view === "cameras"}
        />
      ))}
    </div>
  );
  const loads = <LoadsCard vehicle={vehicle} type={type} stale={old} heard_s={heard_s} />;
  return (
    <div className={`bodyview ${view}`} tabIndex={0} role="group" aria-label={t(`view.${view}`)}>
      {view === "platform" && loads}
      {view === "platform" && !narrow && cameras}
      {view === "cameras" && cameras}
      {view === "lifts" && (
        <LiftsCard key={vehicle.id} vehicle={vehicle} type={type} refused={refused} open />
      )}
      {view === "lifts" && !narrow && loads}
    </div>
  );
}
