import type { JobOrder, JobState } from "@/shared/api/types";
import { isOpen } from "@/shared/commands/orderState";
import type { CommandProgress, SymbolName } from "@/shared/ui";

export { isOpen };

/** Every state has its own shape, so that the table reads in greyscale. */
export const stateSymbol: Record<JobState, SymbolName> = {
  NotAllowedToStart: "s-stale",
  AllowedToStart: "s-wait",
  Running: "s-moving",
  Interrupted: "a-2",
  Ended: "c-ok",
  Aborted: "c-no",
};

/** Open ones first (running, interrupted, waiting), then the newest. */
export function sortOrders(orders: readonly JobOrder[]): JobOrder[] {
  const rank: Record<JobState, number> = {
    Interrupted: 0,
    Running: 1,
    AllowedToStart: 2,
    NotAllowedToStart: 3,
    Ended: 4,
    Aborted: 4,
  };
  return [...orders].sort((a, b) => rank[a.state] - rank[b.state] || b.number - a.number);
}

/** Live orders win over fetched ones unless those are newer; what Cancel or Clear took out is not listed. */
export function mergeOrders(live: readonly JobOrder[], pages: readonly JobOrder[]): JobOrder[] {
  const byId = new Map<string, JobOrder>();
  for (const order of [...pages, ...live]) {
    const known = byId.get(order.id);
    if (!known || order.revision >= known.revision) byId.set(order.id, order);
  }
  return sortOrders([...byId.values()].filter((o) => !o.removed));
}

export function doneSteps(order: JobOrder): number {
  return order.steps.filter((s) => s.state === "done").length;
}

/** A person has asked for the pause of this order, and it holds. */
const isPaused = (order: JobOrder) =>
  order.state === "Interrupted" && order.reason?.code === "paused_by_person";

/** What a person may do with an order now. Pause keeps its place while the order is paused. */
export function actionsOf(order: JobOrder): { pause: boolean; resume: boolean; cancel: boolean } {
  const open = isOpen(order);
  const held = order.state === "Interrupted" || order.state === "NotAllowedToStart";
  return {
    pause: open && (isPaused(order) || (!held && !order.cancel_requested)),
    resume: open && held && !order.cancel_requested,
    cancel: open,
  };
}

/** What Pause of an order shows: never what would let it go on. */
export function pauseProgress(
  order: JobOrder,
  asked: CommandProgress,
  t: (key: string) => string,
): CommandProgress {
  if (isPaused(order)) return { kind: "holds", title: t("command.paused"), small: t("command.pause_holds") };
  if (order.pause_requested)
    return { kind: "under_way", title: t("command.stopping"), small: t("command.pausing") };
  return asked;
}

/** Orders whose name, stations, vehicle or MES number hold what is asked for. */
export function foundOrders(orders: readonly JobOrder[], find: string, open: boolean): JobOrder[] {
  const wanted = find.trim().toLowerCase();
  const texts = (o: JobOrder) => [o.name, o.vehicle || o.wanted_vehicle, o.client_order_id ?? ""];
  return orders.filter(
    (o) =>
      (!open || isOpen(o)) &&
      (texts(o).some((text) => text.toLowerCase().includes(wanted)) ||
        o.steps.some((step) => String(step.number) === wanted)),
  );
}

/** How long an ended order took, in seconds; one that never began took no time. */
export function tookS(order: JobOrder): number | undefined {
  if (order.started_at === undefined || order.ended_at === undefined) return undefined;
  return Math.max(0, (Date.parse(order.ended_at) - Date.parse(order.started_at)) / 1000);
}
