import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { symbolOf, useLinkLost, useLive, useServerNow, useVehicles } from "@/shared/live";
import { Link, navigate } from "@/shared/router";
import { Card, PanelEmpty, PanelLoading, StatusSymbol } from "@/shared/ui";
import { age, fixed } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { LoadOf } from "./LoadOf";
import { byUrgency } from "./urgency";
import { useHeard } from "./useHeard";
import { useAnswer } from "./WhyCard";
import "./VehicleListPage.css";

/** Every vehicle of the plant with what it does and why, the most urgent first; a silent one stays. */
export function VehicleListPage() {
  const { t } = useTranslation("vehicles");
  const vehicles = byUrgency(useVehicles(), useServerNow(1000));
  const ready = useLive((s) => s.ready);
  const live = vehicles.filter((v) => v.link === "live").length;
  return (
    <Card
      className="listpage"
      level={1}
      title={t("list.title")}
      summary={t("list.summary", { live, total: vehicles.length })}
      flush
    >
      {!ready ? (
        <PanelLoading what={t("list.title")} />
      ) : vehicles.length === 0 ? (
        <PanelEmpty what={t("list.empty")} when={t("list.empty_hint")} />
      ) : (
        <div className="scroll" tabIndex={0} role="group" aria-label={t("list.title")}>
          <table className="rows vrows">
            <thead>
              <tr>
                <th>{t("list.vehicle")}</th>
                <th>{t("list.state")}</th>
                <th>{t("list.where")}</th>
                <th>{t("list.why")}</th>
                <th>{t("list.load")}</th>
                <th className="n">{t("list.battery")}</th>
                <th className="n">{t("list.heard")}</th>
              </tr>
            </thead>
            <tbody>
              {vehicles.map((v) => (
                <Row key={v.id} vehicle={v} />
              ))}
            </tbody>
          </table>
        </div>
      )}
    </Card>
  );
}

function Row({ vehicle: v }: { vehicle: Vehicle }) {
  const { t } = useTranslation(["vehicles", "words"]);
  const words = useWords();
  const answer = useAnswer();
  const { heard_s } = useHeard(v);
  const hand = words.inHand(v);
  const lost = useLinkLost();
  const silent = lost || v.link !== "live";
  const to = `/vehicles/${encodeURIComponent(v.id)}`;
  return (
    <tr className={`go ${silent ? "old" : ""}`} onClick={() => navigate(to)}>
      <td className="b">
        <Link className="cell-link" to={to} onClick={(event) => event.stopPropagation()}>
          {v.name}
        </Link>
      </td>
      <td>
        <span className="row">
          <StatusSymbol name={lost ? "s-stale" : symbolOf(v)} />
          {silent ? t(`words:link.${lost ? "lost" : v.link}`) : t(`words:activity.${v.activity}`)}
        </span>
        {hand !== undefined && <span className="hand">{hand}</span>}
      </td>
      <td>
        {v.at_station ? t("list.at", { number: words.stationNumber(v.at_station) }) : t("list.between")}
      </td>
      <td className="wrap">{answer(v)}</td>
      <td>{v.link === "never" ? "\u2013" : <LoadOf vehicle={v} />}</td>
      <td className="n" data-label={t("list.battery")}>
        {v.link === "never" ? "\u2013" : `${fixed(v.battery_percent, 0)} %`}
      </td>
      <td className="n" data-label={t("list.heard")}>
        {heard_s === undefined ? t("list.never") : age(heard_s)}
      </td>
    </tr>
  );
}
