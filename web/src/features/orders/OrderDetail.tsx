import { useTranslation } from "react-i18next";
import type { JobOrder } from "@/shared/api/types";
import { Link } from "@/shared/router";
import { Card, StatusSymbol } from "@/shared/ui";
import { isCancelled, orderStateKey } from "@/shared/words/orderState";
import { useWords } from "@/shared/words/useWords";
import { OrderCommands } from "./OrderCommands";
import { OrderFields } from "./OrderFields";
import { doneSteps, stateSymbol } from "./orderLook";
import { OrderSteps } from "./OrderSteps";
import "./OrderDetail.css";

/** One order: state and why, its stations with their stops, its times. */
export function OrderDetail({ order }: { order: JobOrder }) {
  const { t } = useTranslation(["orders", "words"]);
  const words = useWords();
  const done = doneSteps(order);
  const state = t(orderStateKey(order));
  const why = order.reason && words.reason(order.reason);
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
        {/* Of a cancelled order the reason says what the state says, and by whom. */}
        <span>
          {why === undefined ? state : isCancelled(order) ? why : t("detail.because", { state, why })}
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
      <OrderSteps order={order} />
      <OrderFields order={order} />
    </Card>
  );
}
