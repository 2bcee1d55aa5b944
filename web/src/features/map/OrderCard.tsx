import { useTranslation } from "react-i18next";
import type { JobOrder } from "@/shared/api/types";
import { legProgress, liveStore, useServerNow, useVehicle } from "@/shared/live";
import { Link } from "@/shared/router";
import { Icon, StatusSymbol, type SymbolName } from "@/shared/ui";
import { expectedIn } from "@/shared/words/expected";
import { useExpected } from "@/shared/words/useExpected";
import { useWords } from "@/shared/words/useWords";
import { orderProgress } from "./listRows";

/** One open order: who goes where, how far it is, when it is there or why it is not on its way. */
export function OrderCard({ order }: { order: JobOrder }) {
  const { t } = useTranslation("map");
  const words = useWords();
  const vehicle = useVehicle(order.vehicle || undefined);
  const expected = useExpected();
  const when = expectedIn(order.expected_at, useServerNow(500));
  const last = order.steps[order.steps.length - 1];
  const now = order.steps[order.current_step];
  const measuring = now?.state === "measuring";
  const runs = order.state === "Running" && order.reason === undefined;
  const symbol: SymbolName =
    order.state === "Interrupted" ? "a-2" : !runs ? "s-wait" : measuring ? "s-measure" : "s-moving";
  const mode = words.modeShort(vehicle?.leg?.mode ?? now?.motion_mode ?? "auto");
  const leg = vehicle?.leg;
  // The clock above draws this anew twice a second; where the vehicle is comes without React.
  const driven = leg && legProgress(leg, vehicle && liveStore.poses.get(vehicle.id));
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
        <i style={{ width: `${Math.round(orderProgress(order, leg, driven) * 100)}%` }} />
      </div>
      <div className="row st">
        <StatusSymbol name={symbol} size={15} />
        <span>{text()}</span>
      </div>
    </Link>
  );

  function text(): string {
    if (order.reason !== undefined) return words.reason(order.reason);
    if (measuring) return t("orders.measuring");
    if (when.kind === "late") return t("orders.late", { mode, late: expected.clock(order.expected_at) });
    if (when.kind === "in") return t("orders.ready_at", { mode, time: expected.clock(order.expected_at) });
    return order.vehicle === "" ? t("orders.waits") : t("orders.driving", { mode });
  }
}
