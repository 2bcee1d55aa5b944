import { useTranslation } from "react-i18next";
import type { FleetEvent, StopRecord } from "@/shared/api/types";
import { useServerNow } from "@/shared/live";
import { Link } from "@/shared/router";
import { StatusSymbol } from "@/shared/ui";
import { dateTime, degrees, millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { distance_m } from "./plots/statistics";
import type { ListedStop } from "./stopLists";
import "./results.css";

/** Stops, newest first; each row is the link to its record, or to the order of one that was not measured. */
export function RecordTable({ stops }: { stops: readonly ListedStop[] }) {
  const { t } = useTranslation("records");
  const now = useServerNow(60_000);
  return (
    <table className="rows">
      <thead>
        <tr>
          <th>{t("col.time")}</th>
          <th>{t("col.vehicle")}</th>
          <th>{t("col.station")}</th>
          <th>{t("col.mode")}</th>
          <th className="n">dx mm</th>
          <th className="n">dy mm</th>
          <th className="n">dθ °</th>
          <th className="n">{t("col.distance")}</th>
          <th className="n">{t("col.attempt")}</th>
          <th>{t("col.result")}</th>
        </tr>
      </thead>
      <tbody>
        {stops.map((stop) =>
          "record" in stop ? (
            <Row key={stop.record.id} stop={stop.record} time={dateTime(stop.at, now)} />
          ) : (
            <UnmeasuredRow key={stop.unmeasured.seq} event={stop.unmeasured} time={dateTime(stop.at, now)} />
          ),
        )}
      </tbody>
    </table>
  );
}

function Row({ stop: s, time }: { stop: StopRecord; time: string }) {
  const { t } = useTranslation("records");
  const words = useWords();
  const vehicle = words.vehicle(s.vehicle);
  const mm = (m: number) => millimetres(m, { decimals: 2, sign: true });
  return (
    <tr>
      <td>
        <Link
          className="row-link"
          to={`/records/${s.id}`}
          aria-label={t("row", { time, vehicle, number: s.number })}
        >
          {time}
        </Link>
      </td>
      <td className="b">{vehicle}</td>
      <td className="b" data-label={t("col.station")}>
        {s.number}
      </td>
      <td>{words.modeShort(s.mode)}</td>
      <td className="n" data-label="dx mm">
        {mm(s.dx_m)}
      </td>
      <td className="n" data-label="dy mm">
        {mm(s.dy_m)}
      </td>
      <td className="n" data-label="dθ °">
        {degrees(s.dheading_rad, { sign: true })}
      </td>
      <td className="n" data-label={t("col.distance")}>
        {millimetres(distance_m(s), { decimals: 2 })}
      </td>
      <td className="n" data-label={t("col.attempt")}>
        {s.attempt}
      </td>
      <td className="res">
        <StatusSymbol name={s.inside ? "c-ok" : "a-2"} />
        <span>{t(s.inside ? "inside" : "outside")}</span>
      </td>
    </tr>
  );
}

/** In place of figures the reason, which is all that is known. */
function UnmeasuredRow({ event, time }: { event: FleetEvent; time: string }) {
  const { t } = useTranslation("records");
  const words = useWords();
  const vehicle = words.vehicle(event.vehicle ?? "");
  const { station, attempt } = event.params;
  const number = String(station);
  return (
    <tr>
      <td>
        <Link
          className="row-link"
          to={`/orders/${event.order ?? ""}`}
          aria-label={t("row_unmeasured", { time, vehicle, number })}
        >
          {time}
        </Link>
      </td>
      <td className="b">{vehicle}</td>
      <td className="b" data-label={t("col.station")}>
        {number}
      </td>
      <td className="wrap" colSpan={5}>
        {words.reason({ code: "stop_not_measured", params: event.params })}
      </td>
      <td className="n" data-label={t("col.attempt")}>
        {String(attempt)}
      </td>
      <td className="res">
        <StatusSymbol name="a-2" />
        <span>{t("unmeasured")}</span>
      </td>
    </tr>
  );
}
