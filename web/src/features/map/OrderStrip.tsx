import { useMemo } from "react";
import { useTranslation } from "react-i18next";
import { useJobOrders, useLinkLost, useLive, useServerNow } from "@/shared/live";
import { Link } from "@/shared/router";
import { openOrders } from "./listRows";
import { OrderCard } from "./OrderCard";
import "./OrderStrip.css";

const kShown = 5;

/** Open orders along the bottom of the map, the most urgent first; where there are more, the way to them. */
export function OrderStrip() {
  const { t } = useTranslation("map");
  const orders = useJobOrders();
  const now = useServerNow(5000);
  const open = useMemo(() => openOrders(orders, now), [orders, now]);
  const lost = useLinkLost();
  // Before the first snapshot nobody knows whether there are any.
  const none = useLive((s) => s.ready) && open.length === 0;
  const more = open.length - kShown;
  return (
    <section className={`strip gt-sm ${lost ? "old" : ""}`} aria-label={t("orders.title")}>
      <header>
        <b>{t("orders.title")}</b>
        <span className="cap">
          {none && t("orders.none")}
          {open.length > 0 &&
            (more > 0
              ? t("orders.some", { shown: kShown, count: open.length })
              : t("orders.summary", { count: open.length }))}
        </span>
        {more > 0 && (
          <Link className="inline" to="/orders">
            {t("orders.more", { count: more })}
          </Link>
        )}
      </header>
      <div className="mvs">
        {open.slice(0, kShown).map((order) => (
          <OrderCard key={order.id} order={order} />
        ))}
        {none && <div className="mv idle lab">{t("orders.none_hint")}</div>}
      </div>
    </section>
  );
}
