import { useState } from "react";
import { useTranslation } from "react-i18next";
import { ApiProblem } from "@/shared/api";
import { usePlant } from "@/shared/live";
import { Link, navigate } from "@/shared/router";
import { Card, PanelEmpty, PanelFailed, PanelLoading } from "@/shared/ui";
import { useNarrow } from "@/shared/ui/useNarrow";
import { OrderDetail } from "./OrderDetail";
import { OrderList } from "./OrderList";
import { TourForm } from "./TourForm";
import { useOrder } from "./useOrders";
import "./OrderPanel.css";
import "./OrdersPage.css";

/** Orders: a live table, and beside it one order or a form for a new one. On a small screen one of the two. */
export function OrdersPage({ id }: { id: string | undefined }) {
  const { t } = useTranslation("orders");
  const narrow = useNarrow();
  const plant = usePlant().data;
  const [writing, setWriting] = useState(false);
  const startWriting = () => {
    setWriting(true);
    navigate("/orders");
  };
  const panel =
    id !== undefined ? (
      <Selected id={id} />
    ) : writing ? (
      <TourForm plant={plant} onClose={() => setWriting(false)} />
    ) : undefined;
  if (panel === undefined) return <OrderList selected={undefined} alone onNew={startWriting} />;
  return narrow ? (
    <>
      <h1 className="sr-only">{t("title")}</h1>
      {panel}
    </>
  ) : (
    <div className="ogrid">
      <OrderList selected={id} alone={false} onNew={startWriting} />
      {panel}
    </div>
  );
}

function Selected({ id }: { id: string }) {
  const { t } = useTranslation("orders");
  const { order, query } = useOrder(id);
  if (order) return <OrderDetail key={order.id} order={order} />;
  if (query.isPending) return <PanelLoading what={t("title")} />;
  const gone = query.error instanceof ApiProblem && query.error.status === 404;
  return (
    <Card className="odetail">
      {gone ? (
        <PanelEmpty
          what={t("not_found")}
          action={
            <Link className="btn" to="/orders">
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
