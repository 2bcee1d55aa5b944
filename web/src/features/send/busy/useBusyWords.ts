import { useTranslation } from "react-i18next";
import type { JobOrder, Vehicle } from "@/shared/api/types";
import { useExpected } from "@/shared/words/useExpected";
import { useWords } from "@/shared/words/useWords";
import { goesTo, type Busy } from "./busy";
import { isOnItsWay } from "../preview/preview";

/** Who ends an order that is being ended; undefined: nobody does, or nobody knows. */
export function endedBy(order: JobOrder): string | undefined {
  const actor = order.reason?.params.actor;
  return order.cancel_requested && typeof actor === "string" ? actor : undefined;
}

/** What a vehicle has to do, for whom and until when: "TP-02 is on its way to 7 (JO-7, by anna, there 19:30:47)". */
export function useBusyWords(): (busy: Busy, vehicle: Vehicle) => string {
  const { t } = useTranslation("send");
  const words = useWords();
  const expected = useExpected();
  return (busy, vehicle) => {
    const { order } = busy;
    const values = {
      vehicle: vehicle.name,
      number: goesTo(order) ?? "",
      order: order.name,
      by: words.actor(order.created_by),
      there: expected.clock(order.expected_at ?? vehicle.leg?.expected_at),
    };
    return said() + (busy.waiting.length > 0 ? t("busy.more", more()) : "");

    function said(): string {
      if (order.cancel_requested) {
        const actor = endedBy(order);
        return t(actor === undefined ? "busy.ending" : "busy.ending_by", { ...values, actor });
      }
      if (!busy.has) return t("busy.waits", values);
      if (isOnItsWay(vehicle) && order.state === "Running")
        return t(values.there === undefined ? "start.on_its_way_plain" : "start.on_its_way", values);
      const reason = order.reason ?? vehicle.reason;
      return reason ? t("busy.held", { ...values, why: words.reason(reason) }) : t("busy.has", values);
    }
    function more() {
      const orders = busy.waiting.map((o) => t("busy.one", { order: o.name, by: words.actor(o.created_by) }));
      return { count: busy.waiting.length, orders: orders.join(t("words.join")), vehicle: vehicle.name };
    }
  };
}
