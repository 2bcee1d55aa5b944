import type { JobOrder } from "@/shared/api/types";

type Told = Pick<JobOrder, "state" | "reason">;

/** The API calls an order that a person cancelled Aborted, as one that the fleet gave up; people are told which of the two it was. */
export function isCancelled(order: Told): boolean {
  return order.state === "Aborted" && order.reason?.code === "cancelled_by_person";
}

/** Key of the word for an order's state. */
export function orderStateKey(order: Told): string {
  return `words:job.${isCancelled(order) ? "cancelled" : order.state}`;
}
