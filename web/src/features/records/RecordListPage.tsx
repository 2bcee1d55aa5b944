import { useTranslation } from "react-i18next";
import { navigate, useLocation } from "@/shared/router";
import { Button, Card, PanelEmpty, PanelFailed, PanelLoading, StatusSymbol } from "@/shared/ui";
import { RecordFilters, type FilterName } from "./RecordFilters";
import { RecordTable } from "./RecordTable";
import { kResults, listedStops, resultOf } from "./stopLists";
import { useStopHistory, useUnmeasuredHistory } from "./useStopHistory";

/** All stops, newest first, by vehicle, station and how they came out. The filter is in the address. */
export function RecordListPage() {
  const { t } = useTranslation("records");
  const { query } = useLocation();
  const vehicle = query.get("vehicle") || undefined;
  const wanted = query.get("station");
  const station = wanted && /^\d+$/.test(wanted) ? Number(wanted) : undefined;
  const result = kResults.find((r) => r === query.get("result"));
  const records = useStopHistory({ vehicle, station });
  const unmeasured = useUnmeasuredHistory({ vehicle, station });
  const pages = [records.pages, unmeasured.pages];
  const all = listedStops(
    { items: records.stops, more: records.pages.hasNextPage },
    { items: unmeasured.events, more: unmeasured.pages.hasNextPage },
  );
  const stops = all.filter((s) => result === undefined || resultOf(s) === result);
  const counts = {
    count: all.length,
    outside: all.filter((s) => resultOf(s) === "outside").length,
    unmeasured: all.filter((s) => resultOf(s) === "unmeasured").length,
  };
  const filtered = vehicle !== undefined || station !== undefined || result !== undefined;
  const failed = pages.find((p) => p.isError);
  const loading = pages.some((p) => p.isFetchingNextPage);
  const older = () => {
    for (const p of pages) if (p.hasNextPage) void p.fetchNextPage();
  };
  const again = () => {
    for (const p of pages) if (p.isError) void (p.isFetchNextPageError ? p.fetchNextPage() : p.refetch());
  };

  const filter = (name: FilterName, value: string) => {
    const next = new URLSearchParams(query);
    if (value === "") next.delete(name);
    else next.set(name, value);
    const text = next.toString();
    navigate(`/records${text ? `?${text}` : ""}`, { replace: true });
  };
  const more = pages.some((p) => p.hasNextPage) && !failed && (
    <Button disabled={loading} onPress={older}>
      {t(loading ? "loading" : "older")}
    </Button>
  );
  return (
    <Card className="listpage" level={1} title={t("title")} summary={t("summary", counts)} flush>
      <div className="filters">
        <RecordFilters filter={{ vehicle, station, result }} onFilter={filter} />
        {stops.length > 0 && failed && (
          <div className="row amiss" role="alert">
            <StatusSymbol name="a-2" />
            <span>{t("older_failed")}</span>
            <Button onPress={again}>{t("retry")}</Button>
          </div>
        )}
      </div>
      {stops.length > 0 ? (
        <div className="scroll" tabIndex={0} role="group" aria-label={t("title")}>
          <RecordTable stops={stops} />
          {more}
        </div>
      ) : pages.some((p) => p.isPending) ? (
        <PanelLoading what={t("title")} />
      ) : failed ? (
        <PanelFailed what={t("failed")} error={failed.error} onRetry={again} />
      ) : (
        <>
          <PanelEmpty
            what={t(filtered ? "none_fits" : "empty")}
            when={t(filtered ? "none_fits_hint" : "empty_hint")}
          />
          {more}
        </>
      )}
    </Card>
  );
}
