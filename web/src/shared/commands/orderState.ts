import type { JobOrder } from "@/shared/api/types";

export function isOpen(order: Pick<JobOrder, "state">): boolean {
  return order.state !== "Ended" && order.state !== "Aborted";
}
