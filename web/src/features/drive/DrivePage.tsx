import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import {
  stale,
  symbolOf,
  useHeard,
  useJobOrder,
  useLinkLost,
  useLive,
  usePlant,
  useVehicle,
} from "@/shared/live";
import { MapView } from "@/shared/map";
import { Link } from "@/shared/router";
import { Card, Chip, PanelEmpty, PanelLoading, StatusSymbol, VehicleMini } from "@/shared/ui";
import { useNarrow, useTight } from "@/shared/ui/useNarrow";
import { fixed, kNone } from "@/shared/words/format";
import { DriveDesk } from "./DriveDesk";
import { NextSteps } from "./NextSteps";
import { TargetCard } from "./TargetCard";
import { useHandHeld } from "./useHandHeld";
import "./DrivePage.css";

/** About the vehicle, so that a platform and what is round it fill the map. */
const kAround_m = 9;

/** A person drives one vehicle by hand: two thumbs below, the way to the station and the order at the right. */
export function DrivePage({ id }: { id: string }) {
  const { t } = useTranslation("vehicles");
  const vehicle = useVehicle(id);
  const ready = useLive((s) => s.ready);
  if (vehicle !== undefined) return <Drive vehicle={vehicle} />;
  if (!ready) return <PanelLoading what={id} />;
  return (
    <Card>
      <PanelEmpty what={t("not_found", { id })} when={t("not_found_hint")} />
    </Card>
  );
}

function Drive({ vehicle }: { vehicle: Vehicle }) {
  const { t } = useTranslation("drive");
  const plant = usePlant().data;
  const type = plant?.vehicle_types.find((one) => one.id === vehicle.type);
  const order = useJobOrder(vehicle.order);
  const { control, state } = useHandHeld(vehicle.id);
  const { pose } = useHeard(vehicle);
  const narrow = useNarrow();
  const tight = useTight();
  const way = plant !== undefined && <TargetCard vehicle={vehicle} plant={plant} />;
  const old = useLinkLost() || stale(vehicle);
  const about =
    pose === undefined
      ? undefined
      : [-1, 1].map((side) => ({ x_m: pose.x_m + side * kAround_m, y_m: pose.y_m + side * kAround_m }));
  return (
    <>
      <div className="card head drivehead">
        <VehicleMini type={type} className="drivemini" />
        <div>
          <h1>{t("title", { vehicle: vehicle.name })}</h1>
          <span className="lab nw">{type?.name ?? vehicle.type}</span>
        </div>
        <div className={`chips ${old ? "old" : ""}`}>
          <Chip symbol={symbolOf(vehicle)}>{t(state.mine ? "chip.mine" : "chip.not_mine")}</Chip>
          <Chip symbol={state.line === "open" && !state.slow ? "c-ok" : "a-2"}>
            {t(`chip.line.${state.line}`, {
              ms: state.roundTripMs === undefined ? kNone : fixed(state.roundTripMs, 0),
            })}
          </Chip>
        </div>
        <p className="notsafe lab">
          <StatusSymbol name="a-3" />
          <span>{t("not_safe")}</span>
        </p>
        <Link className="btn" to={`/vehicles/${encodeURIComponent(vehicle.id)}`}>
          {t("to_vehicle")}
        </Link>
      </div>
      <div className="drivegrid">
        {!narrow && (
          <div className="card mapcard">
            {plant !== undefined && pose !== undefined && vehicle.pose_known ? (
              <MapView
                plant={plant}
                hall={vehicle.hall}
                about={about ?? []}
                selected={vehicle.id}
                follow={vehicle.id}
                label={t("map", { vehicle: vehicle.name })}
              />
            ) : (
              <Card title={t("map", { vehicle: vehicle.name })}>
                <p className="lab">{t("target.unknown")}</p>
              </Card>
            )}
          </div>
        )}
        <div className="driveside">
          <NextSteps vehicle={vehicle} type={type} order={order} control={control} state={state} />
          {tight && way}
        </div>
      </div>
      <DriveDesk control={control} state={state} vehicle={vehicle} type={type}>
        {!tight && way}
      </DriveDesk>
    </>
  );
}
