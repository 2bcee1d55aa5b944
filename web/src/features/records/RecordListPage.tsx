import { useTranslation } from "react-i18next";
import { navigate, useLocation } from "@/shared/router";
import { Button, Card, PanelEmpty, PanelFailed, PanelLoading, StatusSymbol } from "@/shared/ui";
import { RecordFilters, type FilterName } from "./RecordFilters";
import { RecordTable } from "./RecordTable";
import { kResults, resultOf } from "./stopLists";
import { useListedStops } from "./useListedStops";

/** All stops, newest first, by vehicle, station and how they came out. The filter is in the address. */
export function RecordListPage() {
  const { t } = useTranslation("records");
  const { query } = useLocation();
  const vehicle = query.get("vehicle") || undefined;
  const wanted = query.get("station");
  const station = wanted && /^\d+$/.test(wanted) ? Number(wanted) : undefined;
  const result = kResults.find((r) => r === query.get("result"));
  const list = useListedStops({ vehicle, station });
  const { stops: all, failed } = list;
  const stops = all.filter((s) => result === undefined || resultOf(s) === result);
  const counts = {
    count: all.length,
    outside: all.filter((s) => resultOf(s) === "outside").length,
    unmeasured: all.filter((s) => resultOf(s) === "unmeasured").length,
  };
  const filtered = vehicle !== undefined || station !== undefined || result !== undefined;

  const filter = (name: FilterName, value: string) => {
    const next = new URLSearchParams(query);
    if (value === "") next.delete(name);
    else next.set(name, value);
    const text = next.toString();
    navigate(`/records${text ? `?${text}` : ""}`, { replace: true });
  };
  const older = list.hasOlder && !failed && (
    <Button disabled={list.loadingOlder} onPress={list.older}>
      {t(list.loadingOlder ? "loading" : "older")}
    </Button>
  );
  return (
    <Card
      className="listpage"
      level={1}
      title={t("title")}
      // What has not been counted is not said to be none.
      {...(!list.pending && !failed && { summary: t("summary", counts) })}
      flush
    >
      <div className="filters">
        <RecordFilters filter={{ vehicle, station, result }} onFilter={filter} />
        {stops.length > 0 && failed && (
          <div className="row amiss" role="alert">
            <StatusSymbol name="a-2" />
            <span>{t("older_failed")}</span>
            <Button onPress={list.again}>{t("retry")}</Button>
          </div>
        )}
      </div>
      {stops.length > 0 ? (
        <div className="scroll" tabIndex={0} role="group" aria-label={t("title")}>
          <RecordTable stops={stops} />
          {older}
        </div>
      ) : list.pending ? (
        <PanelLoading what={t("title")} />
      ) : failed ? (
        <PanelFailed what={t("failed")} error={failed.error} onRetry={list.again} />
      ) : (
        <>
          <PanelEmpty
            what={t(filtered ? "none_fits" : "empty")}
            when={t(filtered ? "none_fits_hint" : "empty_hint")}
          />
          {older}
        </>
      )}
    </Card>
  );
}
