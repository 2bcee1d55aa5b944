import { useMemo, type ReactNode } from "react";
import { useTranslation } from "react-i18next";
import type { JobOrder, Vehicle } from "@/shared/api/types";
import { useClosures, useLive, usePlant, type Heard } from "@/shared/live";
import { Link } from "@/shared/router";
import { dateTime, fixed, length } from "@/shared/words/format";
import { poseWords } from "@/shared/words/poseBasis";
import { expectedIn } from "@/shared/words/expected";
import { useExpected } from "@/shared/words/useExpected";
import type { Words } from "@/shared/words/useWords";
import { longWay } from "./detour";
import { useLasting } from "./vehicleWords";

export interface VehicleFactsProps {
  vehicle: Vehicle;
  order: JobOrder | undefined;
  heard: Heard;
  now: number;
  old: boolean;
  words: Words;
}

/** Since when, how fast, for which order, where to and when there, and what the drawn place rests on. */
export function VehicleFacts({ vehicle: v, order, heard, now, old, words }: VehicleFactsProps) {
  const { t } = useTranslation(["map", "vehicles"]);
  const since = useLive((s) => s.since.get(v.id));
  const lasting = useLasting()(v, since, now);
  const { clock } = useExpected();
  const way = useLongWay(v);
  const { leg } = v;
  const station = leg ? words.stationNumber(leg.station) : order?.steps[order.current_step]?.number;
  const when = v.activity === "moving" ? expectedIn(leg?.expected_at, now).kind : "none";
  const expected = clock(leg?.expected_at);
  const basis = poseWords(v, words.stationNumber, (at) => dateTime(at, now), words.actor);
  const pose = [
    t(`vehicles:pose.basis.${basis.key}`, basis.values),
    basis.since === undefined ? undefined : t("vehicles:pose.since", { length: basis.since }),
    v.pose_known && v.pose_deviation_m !== undefined
      ? t("vehicles:pose.deviation", { length: length(v.pose_deviation_m) })
      : undefined,
  ];
  const rows: [string, ReactNode][] = [];
  if (lasting !== "" && v.link !== "never") rows.push([t("card.since"), lasting]);
  if (heard.speed_mps !== undefined && !old)
    rows.push([t("card.speed"), `${fixed(Math.abs(heard.speed_mps), 2)} m/s`]);
  rows.push([t("card.order"), order === undefined ? t("card.no_order") : <OrderLink order={order} />]);
  if (station !== undefined)
    rows.push([
      t("card.to"),
      when === "none"
        ? t("card.station", { station })
        : when === "late"
          ? t("card.station_late", { station, late: expected })
          : t("card.station_at", { station, time: expected }),
    ]);
  if (way !== undefined)
    rows.push([
      t("card.way"),
      t("card.long_way", { driven: fixed(way.driven_m, 0), direct: fixed(way.direct_m, 0) }),
    ]);
  if (v.link !== "never") rows.push([t("card.pose"), pose.filter(Boolean).join(t("card.join"))]);
  return (
    <dl className="facts">
      {rows.map(([name, value]) => (
        <div key={name}>
          <dt>{name}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}

function OrderLink({ order }: { order: JobOrder }) {
  const { t } = useTranslation("map");
  return (
    <Link className="inline" to={`/orders/${order.id}`}>
      {order.steps.length > 1
        ? t("card.step", { order: order.name, step: order.current_step + 1, steps: order.steps.length })
        : order.name}
    </Link>
  );
}

/** Worked out once a drive: its way stays as it was planned. */
function useLongWay({ type, leg }: Vehicle) {
  const plant = usePlant().data;
  const closures = useClosures();
  const id = leg?.id;
  return useMemo(
    () =>
      plant === undefined || leg === undefined
        ? undefined
        : longWay(plant, type, leg, new Set(closures.flatMap((c) => c.edges))),
    // eslint-disable-next-line react-hooks/exhaustive-deps -- the leg comes anew with each report, its way does not
    [plant, type, id, closures],
  );
}
