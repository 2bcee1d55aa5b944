import { useTranslation } from "react-i18next";
import type { JobOrder } from "@/shared/api/types";
import { useServerNow } from "@/shared/live";
import { Link } from "@/shared/router";
import { StatusSymbol } from "@/shared/ui";
import { dateTime, duration } from "@/shared/words/format";
import { orderStateKey } from "@/shared/words/orderState";
import { useExpected } from "@/shared/words/useExpected";
import { useWords } from "@/shared/words/useWords";
import { isOpen, stateSymbol, tookS } from "./orderLook";
import "./OrderTable.css";

export function OrderTable({
  orders,
  selected,
}: {
  orders: readonly JobOrder[];
  selected: string | undefined;
}) {
  const { t } = useTranslation("orders");
  const now = useServerNow(60_000);
  return (
    <table className="rows orows">
      <thead>
        <tr>
          <th>{t("col.name")}</th>
          <th>{t("col.state")}</th>
          <th>{t("col.steps")}</th>
          <th>{t("col.vehicle")}</th>
          <th>{t("col.why")}</th>
          <th className="n">{t("col.expected")}</th>
          <th className="n">{t("col.created")}</th>
          <th className="n">{t("col.priority")}</th>
          <th className="n">{t("col.due")}</th>
        </tr>
      </thead>
      <tbody>
        {orders.map((order) => (
          <Row key={order.id} order={order} selected={order.id === selected} now={now} />
        ))}
      </tbody>
    </table>
  );
}

function Row({ order, selected, now }: { order: JobOrder; selected: boolean; now: number }) {
  const { t } = useTranslation(["orders", "words"]);
  const words = useWords();
  const expected = useExpected();
  const took = tookS(order);
  const vehicle = order.vehicle || order.wanted_vehicle;
  return (
    <tr className={`${selected ? "on" : ""} ${isOpen(order) ? "" : "closed"}`}>
      <td className="b">
        <Link className="row-link" to={`/orders/${order.id}`} aria-current={selected || undefined}>
          {order.name}
        </Link>
      </td>
      <td>
        <span className="row">
          <StatusSymbol name={stateSymbol[order.state]} />
          {t(orderStateKey(order))}
        </span>
      </td>
      <td>
        <StepLine order={order} />
      </td>
      <td>{vehicle ? words.vehicle(vehicle) : t("any_vehicle")}</td>
      <td className="wrap">{order.reason ? words.reason(order.reason) : ""}</td>
      <td className="n" data-label={t("col.expected")}>
        {isOpen(order)
          ? (expected.clock(order.expected_at) ?? "\u2013")
          : took === undefined
            ? "\u2013"
            : t("took", { time: duration(took) })}
      </td>
      <td className="n" data-label={t("col.created")}>
        {dateTime(order.created_at, now)}
      </td>
      <td className="n" data-label={t("col.priority")}>
        {order.priority}
      </td>
      <td className="n" data-label={t("col.due")}>
        {order.due === undefined ? "\u2013" : dateTime(order.due, now)}
      </td>
    </tr>
  );
}

/** Station numbers in order; done ones ticked, the present one framed. */
export function StepLine({ order }: { order: JobOrder }) {
  const { t } = useTranslation(["orders", "words"]);
  return (
    <ol className="stepline">
      {order.steps.map((s, i) => (
        <li
          key={i}
          className={`${s.state} ${i === order.current_step && isOpen(order) ? "now" : ""}`}
          aria-label={`${s.number}, ${t(`words:step.${s.state}`)}`}
        >
          {s.number}
          {s.state === "done" && <StatusSymbol name="c-ok" size={12} />}
        </li>
      ))}
    </ol>
  );
}
