import { useTranslation } from "react-i18next";
import type { JobOrder, Vehicle } from "@/shared/api/types";
import { CancelOrder, isOpen } from "@/shared/commands";
import { Link } from "@/shared/router";
import { StatusSymbol } from "@/shared/ui";
import { useWords } from "@/shared/words/useWords";
import type { Busy } from "./busy";
import type { Replacing } from "./replacing";
import { useBusyWords } from "./useBusyWords";

export interface WaitsBehindProps {
  order: JobOrder | undefined;
  vehicle: Vehicle;
  /** What the vehicle has to do besides this order. */
  busy: Busy | undefined;
  replacing: Replacing;
}

/** What stands between an order and its vehicle: another's order, how far its cancelling has come, or what has come instead. */
export function WaitsBehind({ order, vehicle, busy, replacing }: WaitsBehindProps) {
  const { t } = useTranslation("send");
  const words = useWords();
  const say = useBusyWords();
  const waits = order !== undefined && isOpen(order) && vehicle.order !== order.id;
  const instead = order?.state === "Aborted";
  const outcome = replacingWords();
  if (!outcome && !(busy && (waits || instead))) return null;
  const names = busy && { order: busy.order.name, by: words.actor(busy.order.created_by) };
  return (
    <div className="behind">
      {outcome && (
        <p role={outcome.failed ? "alert" : "status"} className={outcome.failed ? "failed" : ""}>
          <StatusSymbol name={outcome.failed ? "a-2" : "c-ok"} />
          <span>{outcome.text}</span>
        </p>
      )}
      {busy && (waits || instead) && (
        <>
          <p role="status">
            <StatusSymbol name="s-wait" />
            <span>
              {t(waits ? "behind.waits" : "behind.instead", {
                order: order.name,
                what: say(busy, vehicle),
              })}
            </span>
          </p>
          <div className="row links">
            <Link className="btn motion" to={`/orders/${busy.order.id}`}>
              {t("busy.show", names)}
            </Link>
            {waits && <CancelOrder order={busy.order} label={t("behind.cancel", names)} />}
          </div>
        </>
      )}
    </div>
  );

  function replacingWords(): { text: string; failed: boolean } | undefined {
    if (replacing.kind === "none" || order === undefined) return undefined;
    const other = busy?.order.id === replacing.order.id ? busy.order : undefined;
    const names = {
      other: replacing.order.name,
      by: words.actor(replacing.order.created_by),
      order: order.name,
    };
    if (replacing.kind === "had_ended") return { text: t("behind.had_ended", names), failed: false };
    // What the stream says is newer than an answer that did not come.
    const failed = replacing.kind === "failed" && other !== undefined && !other.cancel_requested;
    if (!failed) return { text: t(other ? "behind.cancelling" : "behind.cancelled", names), failed: false };
    return { text: t("behind.failed", { ...names, why: words.problem(replacing.problem) }), failed: true };
  }
}
