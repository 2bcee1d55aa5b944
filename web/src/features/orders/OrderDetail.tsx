import { useTranslation } from "react-i18next";
import type { JobOrder } from "@/shared/api/types";
import { useServerNow, useStopRecords } from "@/shared/live";
import { Link } from "@/shared/router";
import { Card, StatusSymbol } from "@/shared/ui";
import { dateTime, degrees, millimetres } from "@/shared/words/format";
import { useExpected } from "@/shared/words/useExpected";
import { useWords } from "@/shared/words/useWords";
import { OrderCommands } from "./OrderCommands";
import { OrderFields, StepActions } from "./OrderFields";
import { doneSteps, isOpen, stateSymbol } from "./orderLook";

/** One order: state and why, its stations with their stops, its times. */
export function OrderDetail({ order }: { order: JobOrder }) {
  const { t } = useTranslation(["orders", "words"]);
  const words = useWords();
  const now = useServerNow(60_000);
  const stops = useStopRecords();
  const vehicle = order.vehicle || order.wanted_vehicle;
  const done = doneSteps(order);
  const expected = useExpected();
  return (
    <Card
      className="odetail"
      title={t("detail.title", { name: order.name })}
      right={
        <Link className="btn quiet" to="/orders">
          {t("back_list")}
        </Link>
      }
    >
      <p className="ans1" role="status">
        <StatusSymbol name={stateSymbol[order.state]} />
        <span>
          {t(`words:job.${order.state}`)}
          {order.reason && `${t("join")}${words.reason(order.reason)}`}
        </span>
      </p>
      <div
        className="way"
        role="progressbar"
        aria-label={t("detail.progress", { done, total: order.steps.length })}
        aria-valuenow={done}
        aria-valuemin={0}
        aria-valuemax={order.steps.length}
      >
        <i className="drivenpart" style={{ width: `${(100 * done) / order.steps.length}%` }} />
      </div>
      <span className="cap">{t("detail.progress", { done, total: order.steps.length })}</span>
      <OrderCommands order={order} />
      <table>
        <thead>
          <tr>
            <th>{t("detail.station")}</th>
            <th>{t("detail.mode")}</th>
            <th>{t("detail.state")}</th>
            <th className="n">{t("detail.stop")}</th>
            <th>
              <span className="sr-only">{t("detail.to_record")}</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {order.steps.map((step, i) => {
            const stop = stops.find((s) => s.id === step.stop);
            return (
              <tr key={i} className={i === order.current_step && step.state !== "done" ? "on" : ""}>
                <td className="b">{step.number}</td>
                <td>{words.modeShort(stop?.mode ?? step.motion_mode)}</td>
                <td>
                  {t(`words:step.${step.state}`)}
                  <StepActions step={step} />
                </td>
                <td className="n">
                  {stop ? (
                    <>
                      {millimetres(stop.dx_m, { decimals: 2, sign: true })},{" "}
                      {millimetres(stop.dy_m, { decimals: 2, sign: true })} mm,{" "}
                      {degrees(stop.dheading_rad, { sign: true })}°
                    </>
                  ) : (
                    "\u2013"
                  )}
                </td>
                <td>
                  {step.stop && (
                    <Link className="cell-link" to={`/records/${step.stop}`}>
                      {t("detail.to_record")}
                    </Link>
                  )}
                </td>
              </tr>
            );
          })}
        </tbody>
      </table>
      <dl>
        <dt>{t("detail.vehicle")}</dt>
        <dd>
          {vehicle ? (
            <Link className="inline" to={`/vehicles/${encodeURIComponent(vehicle)}`}>
              {words.vehicle(vehicle)}
            </Link>
          ) : (
            t("any_vehicle")
          )}
        </dd>
        <dt>{t("detail.created")}</dt>
        <dd>
          {dateTime(order.created_at, now)}
          {t("join")}
          {t("detail.by", { actor: words.actor(order.created_by) })}
        </dd>
        <dt>{t("detail.started")}</dt>
        <dd>{dateTime(order.started_at, now)}</dd>
        <dt>{t("detail.expected")}</dt>
        <dd>{(isOpen(order) && expected.clock(order.expected_at)) || "\u2013"}</dd>
        <dt>{t("detail.ended")}</dt>
        <dd>{dateTime(order.ended_at, now)}</dd>
        <dt>{t("detail.priority")}</dt>
        <dd>{order.priority}</dd>
        <OrderFields order={order} now={now} />
        {order.client_order_id && (
          <>
            <dt>{t("detail.client_id")}</dt>
            <dd>{order.client_order_id}</dd>
          </>
        )}
      </dl>
    </Card>
  );
}
