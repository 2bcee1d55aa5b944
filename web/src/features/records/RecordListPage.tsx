import { useTranslation } from "react-i18next";
import { usePlant, useServerNow } from "@/shared/live";
import { Link, navigate, useLocation } from "@/shared/router";
import { Button, Card, PanelEmpty, PanelFailed, PanelLoading, StatusSymbol } from "@/shared/ui";
import { dateTime, degrees, millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { distance_m } from "./statistics";
import { useStopHistory } from "./useStopHistory";

/** All measured stops, newest first, by vehicle and station. The filter is in the address. */
export function RecordListPage() {
  const { t } = useTranslation("records");
  const words = useWords();
  const { query } = useLocation();
  const plant = usePlant().data;
  const now = useServerNow(60_000);
  const vehicle = query.get("vehicle") || undefined;
  const wanted = query.get("station");
  const station = wanted && /^\d+$/.test(wanted) ? Number(wanted) : undefined;
  const { stops, pages } = useStopHistory({ vehicle, station });
  const filtered = vehicle !== undefined || station !== undefined;
  const outside = stops.filter((s) => !s.inside).length;

  const filter = (name: "vehicle" | "station", value: string) => {
    const next = new URLSearchParams(query);
    if (value === "") next.delete(name);
    else next.set(name, value);
    const text = next.toString();
    navigate(`/records${text ? `?${text}` : ""}`, { replace: true });
  };
  return (
    <Card
      className="listpage"
      level={1}
      title={t("title")}
      summary={t("summary", { count: stops.length, outside })}
      flush
    >
      <div className="filters">
        <label className="field">
          <span className="cap">{t("filter.vehicle")}</span>
          <select value={vehicle ?? ""} onChange={(event) => filter("vehicle", event.target.value)}>
            <option value="">{t("filter.all_vehicles")}</option>
            {plant?.vehicles.map((v) => (
              <option key={v.id} value={v.id}>
                {v.name}
              </option>
            ))}
          </select>
        </label>
        <label className="field">
          <span className="cap">{t("filter.station")}</span>
          <select value={station ?? ""} onChange={(event) => filter("station", event.target.value)}>
            <option value="">{t("filter.all_stations")}</option>
            {[...(plant?.stations ?? [])]
              .sort((a, b) => a.number - b.number)
              .map((s) => (
                <option key={s.id} value={s.number}>
                  {s.number}, {s.name}
                </option>
              ))}
          </select>
        </label>
        {stops.length > 0 && pages.isError && (
          <div className="row amiss" role="alert">
            <StatusSymbol name="a-2" />
            <span>{t("older_failed")}</span>
            <Button
              onPress={() => void (pages.isFetchNextPageError ? pages.fetchNextPage() : pages.refetch())}
            >
              {t("retry")}
            </Button>
          </div>
        )}
      </div>
      {stops.length === 0 && pages.isPending ? (
        <PanelLoading what={t("title")} />
      ) : stops.length === 0 && pages.isError ? (
        <PanelFailed what={t("failed")} error={pages.error} onRetry={() => void pages.refetch()} />
      ) : stops.length === 0 ? (
        <PanelEmpty
          what={t(filtered ? "none_fits" : "empty")}
          when={t(filtered ? "none_fits_hint" : "empty_hint")}
        />
      ) : (
        <div className="scroll" tabIndex={0} role="group" aria-label={t("title")}>
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
              {stops.map((s) => (
                <tr key={s.id} className="go" onClick={() => navigate(`/records/${s.id}`)}>
                  <td>
                    <Link
                      className="cell-link"
                      to={`/records/${s.id}`}
                      onClick={(event) => event.stopPropagation()}
                    >
                      {dateTime(s.at, now)}
                    </Link>
                  </td>
                  <td className="b">{words.vehicle(s.vehicle)}</td>
                  <td className="b" data-label={t("col.station")}>
                    {s.number}
                  </td>
                  <td>{words.modeShort(s.mode)}</td>
                  <td className="n" data-label="dx mm">
                    {millimetres(s.dx_m, { decimals: 2, sign: true })}
                  </td>
                  <td className="n" data-label="dy mm">
                    {millimetres(s.dy_m, { decimals: 2, sign: true })}
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
              ))}
            </tbody>
          </table>
          {pages.hasNextPage && !pages.isError && (
            <Button disabled={pages.isFetchingNextPage} onPress={() => void pages.fetchNextPage()}>
              {pages.isFetchingNextPage ? t("loading") : t("older")}
            </Button>
          )}
        </div>
      )}
    </Card>
  );
}
