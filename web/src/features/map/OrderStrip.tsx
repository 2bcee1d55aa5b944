import { useMemo } from "react";
import { useTranslation } from "react-i18next";
import type { JobOrder } from "@/shared/api/types";
import { useJobOrders, useLinkLost, useServerNow, useVehicle } from "@/shared/live";
import { Link } from "@/shared/router";
import { Icon, StatusSymbol, type SymbolName } from "@/shared/ui";
import { expectedIn } from "@/shared/words/expected";
import { useExpected } from "@/shared/words/useExpected";
import { useWords } from "@/shared/words/useWords";
import { openOrders, orderProgress } from "./listRows";

const kShown = 5;

function OrderCard({ order }: { order: JobOrder }) {
  const { t } = useTranslation("map");
  const words = useWords();
  const vehicle = useVehicle(order.vehicle || undefined);
  const expected = useExpected();
  const when = expectedIn(order.expected_at, useServerNow(500));
  const last = order.steps[order.steps.length - 1];
  const now = order.steps[order.current_step];
  const runs = order.state === "Running" && order.reason === undefined;
  const symbol: SymbolName = runs ? (now?.state === "measuring" ? "s-measure" : "s-moving") : "s-wait";
  const mode = words.modeShort(vehicle?.leg?.mode ?? now?.motion_mode ?? "auto");
  const text =
    order.reason !== undefined
      ? words.reason(order.reason)
      : now?.state === "measuring"
        ? t("orders.measuring")
        : when.kind !== "none"
          ? when.kind === "late"
            ? t("orders.late", { mode, late: expected.clock(order.expected_at) })
            : t("orders.ready_at", { mode, time: expected.clock(order.expected_at) })
          : order.vehicle === ""
            ? t("orders.waits")
            : t("orders.driving", { mode });
  const who = order.vehicle || order.wanted_vehicle;
  return (
    <Link className="mv" to={`/orders/${order.id}`}>
      <div className="row">
        <b>{who === "" ? t("orders.any") : words.vehicle(who)}</b>
        <Icon name="right" size={18} />
        <b>
          {order.steps.length > 3 ? `… ${last?.number ?? ""}` : order.steps.map((s) => s.number).join(" · ")}
        </b>
        <span className="grow" />
        <span className="cap">{order.name}</span>
      </div>
      <div className="bar">
        <i style={{ width: `${Math.round(orderProgress(order, vehicle?.leg) * 100)}%` }} />
      </div>
      <div className="row st">
        <StatusSymbol name={symbol} size={15} />
        <span>{text}</span>
      </div>
    </Link>
  );
}

/** Open orders along the bottom of the map, those under way first. */
export function OrderStrip() {
  const { t } = useTranslation("map");
  const orders = useJobOrders();
  const open = useMemo(() => openOrders(orders), [orders]);
  const lost = useLinkLost();
  return (
    <section className={`strip gt-sm ${lost ? "old" : ""}`} aria-label={t("orders.title")}>
      <header>
        <b>{t("orders.title")}</b>
        <span className="cap">
          {open.length === 0 ? t("orders.none") : t("orders.summary", { count: open.length })}
        </span>
      </header>
      <div className="mvs">
        {open.slice(0, kShown).map((order) => (
          <OrderCard key={order.id} order={order} />
        ))}
        {open.length === 0 && <div className="mv idle lab">{t("orders.none_hint")}</div>}
      </div>
    </section>
  );
}
