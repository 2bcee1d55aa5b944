import { useTranslation } from "react-i18next";
import { navigate, useLocation } from "@/shared/router";
import { Button, Card, PanelEmpty, PanelFailed, PanelLoading, StatusSymbol } from "@/shared/ui";
import { RecordFilters } from "./RecordFilters";
import { RecordTable } from "./RecordTable";
import { useStopHistory } from "./useStopHistory";

/** All measured stops, newest first, by vehicle and station. The filter is in the address. */
export function RecordListPage() {
  const { t } = useTranslation("records");
  const { query } = useLocation();
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
        <RecordFilters filter={{ vehicle, station }} onFilter={filter} />
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
      {stops.length > 0 ? (
        <div className="scroll" tabIndex={0} role="group" aria-label={t("title")}>
          <RecordTable stops={stops} />
          {pages.hasNextPage && !pages.isError && (
            <Button disabled={pages.isFetchingNextPage} onPress={() => void pages.fetchNextPage()}>
              {pages.isFetchingNextPage ? t("loading") : t("older")}
            </Button>
          )}
        </div>
      ) : pages.isPending ? (
        <PanelLoading what={t("title")} />
      ) : pages.isError ? (
        <PanelFailed what={t("failed")} error={pages.error} onRetry={() => void pages.refetch()} />
      ) : (
        <PanelEmpty
          what={t(filtered ? "none_fits" : "empty")}
          when={t(filtered ? "none_fits_hint" : "empty_hint")}
        />
      )}
    </Card>
  );
}
