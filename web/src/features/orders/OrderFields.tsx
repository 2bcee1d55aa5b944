import { Fragment, type ReactNode } from "react";
import { useTranslation } from "react-i18next";
import type { JobOrder, Step } from "@/shared/api/types";
import { Link } from "@/shared/router";
import { dateTime } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";

/** What only some orders have: when they may start, after which others, on which vehicle, made by what. */
export function OrderFields({ order, now }: { order: JobOrder; now: number }) {
  const { t } = useTranslation("orders");
  const words = useWords();
  const rows: [string, ReactNode][] = [];
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
  return rows.map(([name, value]) => (
    <Fragment key={name}>
      <dt>{name}</dt>
      <dd>{value}</dd>
    </Fragment>
  ));
}

function Dependencies({ after }: { after: NonNullable<JobOrder["after"]> }) {
  const { t } = useTranslation(["orders", "words"]);
  return after.map((one, i) => (
    <Fragment key={one.order}>
      {i > 0 && t("join")}
      <Link className="inline" to={`/orders/${one.order}`}>
        {one.name}
      </Link>
      {one.outcome && ` (${t(`words:job.${one.outcome}`)})`}
    </Fragment>
  ));
}

/** The actions around a step, in the order in which they are done. */
export function StepActions({ step }: { step: Step }) {
  const { t } = useTranslation("orders");
  const names = (actions: Step["before"]) => actions?.map((a) => a.type).join(t("join"));
  return (
    <>
      {step.before && (
        <div className="cap">{t("detail.actions_before", { actions: names(step.before) })}</div>
      )}
      {step.after && <div className="cap">{t("detail.actions_after", { actions: names(step.after) })}</div>}
    </>
  );
}
