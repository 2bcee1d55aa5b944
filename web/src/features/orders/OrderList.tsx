import { useState } from "react";
import { useTranslation } from "react-i18next";
import { useLive, useMayCommand } from "@/shared/live";
import { Button, Card, PanelEmpty, PanelFailed, PanelLoading, SearchField } from "@/shared/ui";
import { foundOrders, isOpen } from "./orderLook";
import { OrderTable } from "./OrderTable";
import { useOrders } from "./useOrders";

export interface OrderListProps {
  selected: string | undefined;
  /** Nothing stands beside it: its button is the page's first one. */
  alone: boolean;
  onNew: () => void;
}

/** All orders, live, with what finds one of them. */
export function OrderList({ selected, alone, onNew }: OrderListProps) {
  const { t } = useTranslation("orders");
  const ready = useLive((s) => s.ready);
  const mayCommand = useMayCommand();
  const { orders, older } = useOrders();
  const [find, setFind] = useState("");
  const [onlyOpen, setOnlyOpen] = useState(false);
  const found = foundOrders(orders, find, onlyOpen);
  const running = orders.filter((o) => o.state === "Running").length;
  return (
    <Card
      className="listpage orders"
      level={1}
      title={t("title")}
      summary={t("summary", { open: orders.filter(isOpen).length, running })}
      right={
        mayCommand && (
          <Button icon="plus" primary={alone} onPress={onNew}>
            {t("new")}
          </Button>
        )
      }
      flush
    >
      {orders.length > 0 ? (
        <div className="scroll" tabIndex={0} role="group" aria-label={t("title")}>
          <div className="fields ofind">
            <SearchField label={t("find")} text={find} onText={setFind} />
            <Button pressed={onlyOpen} onPress={() => setOnlyOpen((on) => !on)}>
              {t("only_open")}
            </Button>
          </div>
          {found.length === 0 ? (
            <PanelEmpty what={t("none_fits")} when={t("none_fits_hint")} />
          ) : (
            <OrderTable orders={found} selected={selected} />
          )}
          {older.hasNextPage && (
            <Button disabled={older.isFetchingNextPage} onPress={() => void older.fetchNextPage()}>
              {older.isFetchingNextPage ? t("loading") : t("older")}
            </Button>
          )}
        </div>
      ) : !ready ? (
        <PanelLoading what={t("title")} />
      ) : older.isError ? (
        <PanelFailed what={t("failed")} error={older.error} onRetry={() => void older.refetch()} />
      ) : (
        <PanelEmpty what={t("empty")} when={t("empty_hint")} />
      )}
    </Card>
  );
}
