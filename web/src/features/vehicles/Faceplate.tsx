import { useMemo, useState } from "react";
import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { HeldBar, useHeldWords, useRefusal } from "@/shared/commands";
import {
  stale,
  symbolOf,
  useJobOrder,
  useLinkLost,
  usePlant,
  useServerNow,
  useStations,
  useStopRecords,
} from "@/shared/live";
import { Link } from "@/shared/router";
import { Card, PanelEmpty, StatusSymbol, Tabs, VehicleMini } from "@/shared/ui";
import { useNarrow } from "@/shared/ui/useNarrow";
import { age } from "@/shared/words/format";
import { CameraCard } from "@/shared/body/CameraCard";
import { ElsewhereCard } from "./ElsewhereCard";
import { FixesCard } from "./FixesCard";
import { IntegrationCard } from "./IntegrationCard";
import { LiftsCard } from "@/shared/body/LiftsCard";
import { LoadsCard } from "@/shared/body/LoadsCard";
import { PoseCard } from "./PoseCard";
import { shownCameras } from "@/shared/body/shownCameras";
import { StopsCard } from "./StopsCard";
import { useHeard } from "./useHeard";
import { VehicleChips } from "./VehicleChips";
import { VehicleCommands } from "./VehicleCommands";
import { useAnswer, WhyCard } from "./WhyCard";
import "./Faceplate.css";

const kLate_s = 2;

/** Faceplate of one vehicle (Tang 2020, Fig. 12). */
export function Faceplate({ vehicle }: { vehicle: Vehicle }) {
  const { t } = useTranslation("vehicles");
  const narrow = useNarrow();
  const plant = usePlant().data;
  const type = plant?.vehicle_types.find((v) => v.id === vehicle.type);
  const now = useServerNow(500);
  const order = useJobOrder(vehicle.order);
  const stations = useStations();
  const allStops = useStopRecords();
  const stops = useMemo(() => allStops.filter((s) => s.vehicle === vehicle.id), [allStops, vehicle.id]);
  const answer = useAnswer();
  const held = useHeldWords();
  const [tab, setTab] = useState("loads");
  const refused = useRefusal();
  const heard = useHeard(vehicle);
  const { heard_s } = heard;
  const target = stations.find((s) => s.id === vehicle.leg?.station)?.state;

  const lost = useLinkLost();
  const old = lost || stale(vehicle) || (heard_s ?? Infinity) >= kLate_s;
  const lifts = <LiftsCard key={vehicle.id} vehicle={vehicle} type={type} refused={refused} />;
  const loads = <LoadsCard vehicle={vehicle} type={type} stale={old} heard_s={heard_s} />;
  const shown = shownCameras(vehicle, type);
  const cameras =
    shown.length === 0 ? (
      <Card title={t("tabs.cameras")}>
        <PanelEmpty what={t("body:camera.none")} />
      </Card>
    ) : (
      shown.map(({ name, camera }) => (
        <CameraCard
          key={name}
          vehicle={vehicle}
          name={name}
          camera={camera}
          type={type?.cameras.find((x) => x.name === name)}
          now={now}
          steps={narrow}
        />
      ))
    );
  const eyeless = type?.cameras.length === 0 && shown.length === 0;
  /** The bar above says it already. */
  const said = answer(vehicle) === held(vehicle);
  const why = (
    <>
      {!narrow && <HeldBar vehicle={vehicle} />}
      <ElsewhereCard key={vehicle.id} vehicle={vehicle} plant={plant} refused={refused} />
      <WhyCard vehicle={vehicle} type={type} target={target} heard_s={heard_s} stale={old} />
      <PoseCard vehicle={vehicle} heard={heard} now={now} />
      <FixesCard fixes={vehicle.fixes ?? []} now={now} />
      {!narrow && lifts}
      <IntegrationCard key={vehicle.integration} vehicle={vehicle} refused={refused} />
    </>
  );
  const last = <StopsCard stops={stops} now={now} />;

  return (
    <>
      <div className="card head vhead">
        <VehicleMini type={type} className="hmini" />
        <div>
          <h1>{vehicle.name}</h1>
          <span className="lab nw">{type?.name ?? vehicle.type}</span>
        </div>
        <VehicleChips vehicle={vehicle} stale={old} />
        <div className="grow" />
        <VehicleCommands vehicle={vehicle} order={order} />
      </div>
      {narrow ? (
        <>
          <HeldBar vehicle={vehicle} />
          <div className="card whyl" hidden={said && !order}>
            {!said && <StatusSymbol name={symbolOf(vehicle)} />}
            {!said && <b>{answer(vehicle)}</b>}
            {order && (
              <Link className="btn" to={`/orders/${order.id}`}>
                {t("command.order", { order: order.name })}
              </Link>
            )}
            <span className="cap">{age(heard_s)}</span>
          </div>
          <div className="facetabs">
            <Tabs
              label={t("tabs.label")}
              selected={tab}
              onSelect={setTab}
              items={[
                {
                  id: "loads",
                  title: t("tabs.loads"),
                  content: (
                    <>
                      {loads}
                      {lifts}
                    </>
                  ),
                },
                ...(eyeless
                  ? []
                  : [
                      {
                        id: "cameras",
                        title: t("tabs.cameras"),
                        content: <div className="cams">{cameras}</div>,
                      },
                    ]),
                { id: "why", title: t("tabs.why"), content: <div className="vr">{why}</div> },
                { id: "stops", title: t("tabs.stops"), content: last },
              ]}
            />
          </div>
        </>
      ) : (
        <div className="vgrid">
          <div className="vl">
            {loads}
            {!eyeless && <div className="cams">{cameras}</div>}
          </div>
          <div className="vr">
            {why}
            {last}
          </div>
        </div>
      )}
    </>
  );
}
