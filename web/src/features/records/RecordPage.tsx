import { useTranslation } from "react-i18next";
import { ApiProblem } from "@/shared/api";
import { Link } from "@/shared/router";
import { Card, PanelEmpty, PanelFailed, PanelLoading } from "@/shared/ui";
import { Record } from "./Record";
import { useStop } from "./useStopHistory";

/** The page of one measured stop, once it is here. */
export function RecordPage({ id }: { id: string }) {
  const { t } = useTranslation("records");
  const { stop, query } = useStop(id);
  if (stop) return <Record stop={stop} />;
  if (query.isPending) return <PanelLoading what={t("title")} />;
  const gone = query.error instanceof ApiProblem && query.error.status === 404;
  return (
    <Card>
      {gone ? (
        <PanelEmpty
          what={t("not_found")}
          action={
            <Link className="btn" to="/records">
              {t("back")}
            </Link>
          }
        />
      ) : (
        <PanelFailed what={t("failed")} error={query.error} onRetry={() => void query.refetch()} />
      )}
    </Card>
  );
}
