import { useState } from "react";
import { useTranslation } from "react-i18next";
import { ApiProblem } from "@/shared/api";
import { useLive, useMayCommand, usePlant } from "@/shared/live";
import { Link, navigate } from "@/shared/router";
import { Button, Card, PanelEmpty, PanelFailed, PanelLoading } from "@/shared/ui";
import { useNarrow } from "@/shared/ui/useNarrow";
import { OrderDetail } from "./OrderDetail";
import { foundOrders, isOpen } from "./orderLook";
import { OrderTable } from "./OrderTable";
import { TourForm } from "./TourForm";
import { useOrder, useOrders } from "./useOrders";

/** Orders: a live table, one order beside it, and a form for a new one. */
export function OrdersPage({ id }: { id: string | undefined }) {
  const { t } = useTranslation("orders");
  const narrow = useNarrow();
  const plant = usePlant().data;
  const ready = useLive((s) => s.ready);
  const mayCommand = useMayCommand();
  const { orders, older } = useOrders();
  const [writing, setWriting] = useState(false);
  const [find, setFind] = useState("");
  const [onlyOpen, setOnlyOpen] = useState(false);
  const found = foundOrders(orders, find, onlyOpen);
  const side = writing && id === undefined ? "tour" : id !== undefined ? "order" : undefined;
  const running = orders.filter((o) => o.state === "Running").length;
  const table = (
    <Card
      className="listpage"
      level={1}
      title={t("title")}
      summary={t("summary", { open: orders.filter(isOpen).length, running })}
      right={
        mayCommand && (
          <Button
            icon="plus"
            primary={side === undefined}
            onPress={() => {
              setWriting(true);
              navigate("/orders");
            }}
          >
            {t("new")}
          </Button>
        )
      }
      flush
    >
      {orders.length === 0 && !ready ? (
        <PanelLoading what={t("title")} />
      ) : orders.length === 0 && older.isError ? (
        <PanelFailed what={t("failed")} error={older.error} onRetry={() => void older.refetch()} />
      ) : orders.length === 0 ? (
        <PanelEmpty what={t("empty")} when={t("empty_hint")} />
      ) : (
        <div className="scroll" tabIndex={0} role="group" aria-label={t("title")}>
          <div className="fields ofind">
            <label className="field">
              <span className="cap">{t("find")}</span>
              <input type="search" value={find} onChange={(event) => setFind(event.target.value)} />
            </label>
            <Button pressed={onlyOpen} onPress={() => setOnlyOpen((on) => !on)}>
              {t("only_open")}
            </Button>
          </div>
          {found.length === 0 ? (
            <PanelEmpty what={t("none_fits")} when={t("none_fits_hint")} />
          ) : (
            <OrderTable orders={found} selected={id} />
          )}
          {older.hasNextPage && (
            <Button disabled={older.isFetchingNextPage} onPress={() => void older.fetchNextPage()}>
              {older.isFetchingNextPage ? t("loading") : t("older")}
            </Button>
          )}
        </div>
      )}
    </Card>
  );
  if (side === undefined) return table;
  const panel =
    side === "tour" ? (
      <TourForm plant={plant} onClose={() => setWriting(false)} />
    ) : (
      <Selected id={id ?? ""} />
    );
  return narrow ? (
    <>
      <h1 className="sr-only">{t("title")}</h1>
      {panel}
    </>
  ) : (
    <div className="ogrid">
      {table}
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
