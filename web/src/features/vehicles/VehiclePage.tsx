import { useMemo, useState } from "react";
import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { HeldBar, useHeldWords, useRefusal } from "@/shared/commands";
import {
  stale,
  symbolOf,
  useJobOrder,
  useLinkLost,
  useLive,
  usePlant,
  useServerNow,
  useStations,
  useStopRecords,
  useVehicle,
} from "@/shared/live";
import { Link } from "@/shared/router";
import { Card, Chip, PanelEmpty, PanelLoading, StatusSymbol, Tabs } from "@/shared/ui";
import { useNarrow } from "@/shared/ui/useNarrow";
import { age, fixed, mass } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { CameraCard } from "./CameraCard";
import { feetDown } from "./faceplate";
import { ElsewhereCard } from "./ElsewhereCard";
import { IntegrationCard } from "./IntegrationCard";
import { summarise } from "./loads";
import { PlatformDrawing } from "./PlatformDrawing";
import { PoseCard } from "./PoseCard";
import { StopsCard } from "./StopsCard";
import { useHeard } from "./useHeard";
import { VehicleCommands } from "./VehicleCommands";
import { useAnswer, WhyCard } from "./WhyCard";

const kLate_s = 2;

/** Faceplate of one vehicle (Tang 2020, Fig. 12). */
export function VehiclePage({ id }: { id: string }) {
  const { t } = useTranslation("vehicles");
  const vehicle = useVehicle(id);
  const ready = useLive((s) => s.ready);
  if (vehicle) return <Faceplate vehicle={vehicle} />;
  if (!ready) return <PanelLoading what={id} />;
  return (
    <Card>
      <PanelEmpty
        what={t("not_found", { id })}
        when={t("not_found_hint")}
        action={
          <Link className="btn" to="/vehicles">
            {t("to_list")}
          </Link>
        }
      />
    </Card>
  );
}

function Faceplate({ vehicle }: { vehicle: Vehicle }) {
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
  const loads = <LoadsCard vehicle={vehicle} stale={old} heard_s={heard_s} />;
  const cameras =
    vehicle.cameras.length === 0 ? (
      <Card title={t("tabs.cameras")}>
        <PanelEmpty what={t("camera.none")} />
      </Card>
    ) : (
      vehicle.cameras.map((c) => (
        <CameraCard
          key={c.name}
          vehicle={vehicle}
          camera={c}
          type={type?.cameras.find((x) => x.name === c.name)}
          now={now}
        />
      ))
    );
  const why = (
    <>
      {!narrow && <HeldBar vehicle={vehicle} />}
      <ElsewhereCard key={vehicle.id} vehicle={vehicle} plant={plant} refused={refused} />
      <WhyCard vehicle={vehicle} type={type} target={target} heard_s={heard_s} stale={old} />
      <PoseCard vehicle={vehicle} heard={heard} now={now} />
      <IntegrationCard key={vehicle.integration} vehicle={vehicle} refused={refused} />
    </>
  );
  const last = <StopsCard stops={stops} now={now} />;

  return (
    <>
      <div className="card head">
        <svg viewBox="-6 -1.6 12 3.2" className="hmini" aria-hidden="true">
          <rect x="-5.25" y="-1.25" width="10.5" height="2.5" rx=".2" fill="var(--veh)" />
          <path d="M4.7 0L3.3 .85L3.65 0L3.3-.85Z" fill="var(--veh-mark)" />
        </svg>
        <div>
          <h1>{vehicle.name}</h1>
          <span className="lab nw">{type?.name ?? vehicle.type}</span>
        </div>
        <Chips vehicle={vehicle} stale={old} />
        <div className="grow" />
        <VehicleCommands vehicle={vehicle} order={order} />
      </div>
      {narrow ? (
        <>
          <HeldBar vehicle={vehicle} />
          <div className="card whyl" hidden={answer(vehicle) === held(vehicle)}>
            <StatusSymbol name={symbolOf(vehicle)} />
            <b>{answer(vehicle)}</b>
            <span className="cap">{age(heard_s)}</span>
          </div>
          <div className="vtabs">
            <Tabs
              label={t("tabs.label")}
              selected={tab}
              onSelect={setTab}
              items={[
                { id: "loads", title: t("tabs.loads"), content: loads },
                { id: "cameras", title: t("tabs.cameras"), content: <div className="cams">{cameras}</div> },
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
            <div className="cams">{cameras}</div>
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

function LoadsCard({
  vehicle,
  stale,
  heard_s,
}: {
  vehicle: Vehicle;
  stale: boolean;
  heard_s: number | undefined;
}) {
  const { t } = useTranslation("vehicles");
  const type = usePlant().data?.vehicle_types.find((v) => v.id === vehicle.type);
  const summary = summarise(vehicle, type);
  const parts: string[] = [];
  if (summary) {
    parts.push(
      summary.total_n < 1000
        ? t("loads.no_load")
        : summary.balanced
          ? t("loads.balanced", { count: summary.brackets.length * 2 })
          : t("loads.unbalanced", { percent: fixed(summary.worst * 100, 1) }),
    );
  }
  if (vehicle.parking_feet.length > 0) {
    parts.push(t(feetDown(vehicle.parking_feet) ? "loads.feet_lowered" : "loads.feet_raised"));
  }
  return (
    <Card
      className="pcard"
      title={t("loads.title")}
      summary={parts.join(t("join"))}
      right={age(heard_s)}
      flush
    >
      <PlatformDrawing vehicle={vehicle} type={type} stale={stale} />
    </Card>
  );
}

function Chips({ vehicle, stale }: { vehicle: Vehicle; stale: boolean }) {
  const { t } = useTranslation(["vehicles", "words"]);
  const words = useWords();
  const loaded = vehicle.load_name !== "" || vehicle.load_kg > 0;
  const stopped = vehicle.e_stop !== undefined && vehicle.e_stop !== "" && vehicle.e_stop !== "NONE";
  return (
    <div className={`chips ${stale ? "old" : ""}`}>
      <Chip symbol={symbolOf(vehicle)}>
        {vehicle.link !== "live"
          ? t(`words:link.${vehicle.link}`)
          : vehicle.at_station && vehicle.activity !== "moving"
            ? t("chip.at_station", { number: words.stationNumber(vehicle.at_station) })
            : t(`words:activity.${vehicle.activity}`)}
      </Chip>
      {vehicle.integration !== "utilise" && (
        <Chip symbol="a-2">{t(`integration.level.${vehicle.integration}`)}</Chip>
      )}
      {!vehicle.pose_known && <Chip symbol="a-2">{t("chip.pose_unknown")}</Chip>}
      {vehicle.link !== "never" && (
        <>
          <Chip>
            {t(`words:operating_mode.${vehicle.operating_mode}`, { defaultValue: vehicle.operating_mode })}
          </Chip>
          <Chip>
            {loaded
              ? [vehicle.load_name, mass(vehicle.load_kg)].filter(Boolean).join(", ")
              : t("chip.no_load")}
          </Chip>
          <Chip symbol="s-charge">{fixed(vehicle.battery_percent, 0)} %</Chip>
          <Chip symbol={stopped || vehicle.field_violation ? "a-2" : stale ? "s-stale" : "c-ok"}>
            {stopped
              ? t("chip.e_stop")
              : t(vehicle.field_violation ? "chip.field_violation" : "chip.fields_clear")}
          </Chip>
        </>
      )}
    </div>
  );
}
