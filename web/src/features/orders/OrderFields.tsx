import { Fragment, type ReactNode } from "react";
import { useTranslation } from "react-i18next";
import type { JobOrder } from "@/shared/api/types";
import { useServerNow } from "@/shared/live";
import { Link } from "@/shared/router";
import { dateTime } from "@/shared/words/format";
import { orderStateKey } from "@/shared/words/orderState";
import { useExpected } from "@/shared/words/useExpected";
import { useWords } from "@/shared/words/useWords";
import { isOpen } from "./orderLook";
import { useOrder } from "./useOrders";

type Row = [name: string, value: ReactNode];

/** Whose an order is and its times, then what only some orders have. */
export function OrderFields({ order }: { order: JobOrder }) {
  const rows = [...useUsual(order), ...useUnusual(order)];
  return (
    <dl>
      {rows.map(([name, value]) => (
        <Fragment key={name}>
          <dt>{name}</dt>
          <dd>{value}</dd>
        </Fragment>
      ))}
    </dl>
  );
}

function useUsual(order: JobOrder): Row[] {
  const { t } = useTranslation("orders");
  const words = useWords();
  const now = useServerNow(60_000);
  const expected = useExpected();
  const vehicle = order.vehicle || order.wanted_vehicle;
  const by = t("detail.by", { actor: words.actor(order.created_by) });
  return [
    [
      t("detail.vehicle"),
      vehicle ? (
        <Link className="inline" to={`/vehicles/${encodeURIComponent(vehicle)}`}>
          {words.vehicle(vehicle)}
        </Link>
      ) : (
        t("any_vehicle")
      ),
    ],
    [t("detail.created"), dateTime(order.created_at, now) + t("join") + by],
    [t("detail.started"), dateTime(order.started_at, now)],
    [t("detail.expected"), (isOpen(order) && expected.clock(order.expected_at)) || "\u2013"],
    [t("detail.ended"), dateTime(order.ended_at, now)],
    [t("detail.priority"), order.priority],
  ];
}

/** When an order may start, after which others, on which vehicle, made by what. */
function useUnusual(order: JobOrder): Row[] {
  const { t } = useTranslation("orders");
  const words = useWords();
  const now = useServerNow(60_000);
  const rows: Row[] = [];
  if (order.vehicle_type) rows.push([t("detail.vehicle_type"), order.vehicle_type]);
  if (order.earliest_start) rows.push([t("detail.earliest"), dateTime(order.earliest_start, now)]);
  if (order.due) rows.push([t("detail.due"), dateTime(order.due, now)]);
  if (order.after) rows.push([t("detail.after"), <Dependencies after={order.after} />]);
  if (order.sequence) {
    const vehicle = order.sequence_vehicle && words.vehicle(order.sequence_vehicle);
    const on = vehicle ? `${t("join")}${t("detail.on_vehicle", { vehicle })}` : "";
    rows.push([t("detail.sequence"), order.sequence + on]);
  }
  if (order.template) rows.push([t("detail.template"), order.template]);
  if (order.schedule) rows.push([t("detail.schedule"), t("detail.yes")]);
  if (order.client_order_id) rows.push([t("detail.client_id"), order.client_order_id]);
  return rows;
}

type Dependency = NonNullable<JobOrder["after"]>[number];

function Dependencies({ after }: { after: readonly Dependency[] }) {
  const { t } = useTranslation("orders");
  return after.map((one, i) => (
    <Fragment key={one.order}>
      {i > 0 && t("join")}
      <Link className="inline" to={`/orders/${one.order}`}>
        {one.name}
      </Link>
      {one.outcome && <Outcome of={one.order} state={one.outcome} />}
    </Fragment>
  ));
}

/** How the order ended; only itself knows whether a person cancelled it. */
function Outcome({ of, state }: { of: string; state: JobOrder["state"] }) {
  const { t } = useTranslation("words");
  const { order } = useOrder(of);
  return ` (${t(orderStateKey(order ?? { state }))})`;
}
