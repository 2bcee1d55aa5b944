import type { JobOrder, Plant, Pose, Vehicle } from "@/shared/api/types";
import { isOpen } from "@/shared/commands";

/** What a vehicle has to end before a new move of it begins. */
export interface Busy {
  /** The order that it has, else the first of those that wait for it: what Replace takes the place of. */
  order: JobOrder;
  /** It has the order; else the order still waits for it. */
  has: boolean;
  /** More that wait for the vehicle, in the order they came. */
  waiting: readonly JobOrder[];
}

/** Orders of anybody that a vehicle has or that wait for it; `but`: one that does not count. */
export function busyWith(
  vehicle: Pick<Vehicle, "id" | "order"> | undefined,
  orders: readonly JobOrder[],
  but?: string,
): Busy | undefined {
  if (vehicle === undefined) return undefined;
  const { id } = vehicle;
  const open = orders
    .filter((o) => isOpen(o) && o.id !== but && (o.vehicle === id || o.wanted_vehicle === id))
    .sort((a, b) => a.number - b.number);
  const own = open.find((o) => o.id === vehicle.order) ?? open.find((o) => o.vehicle === id);
  const order = own ?? open[0];
  if (order === undefined) return undefined;
  return { order, has: own !== undefined, waiting: open.filter((o) => o !== order) };
}

/** Changes whenever the place changes from which a move that is sent now would begin. */
export const busyKey = (busy: Busy | undefined): string =>
  busy === undefined ? "" : [busy.order, ...busy.waiting].map((o) => o.id).join(",");

/** The number of the station that an order goes to now. */
export function goesTo(order: JobOrder): number | undefined {
  return order.steps[Math.min(order.current_step, order.steps.length - 1)]?.number;
}

const kSamePlace_m = 1e-3;

/** The number of the station whose drawn pose a preview begins at; undefined: it begins elsewhere. */
export function startsAt(start: Pose | undefined, plant: Plant | undefined): number | undefined {
  if (start === undefined) return undefined;
  return plant?.stations.find(
    (s) => Math.hypot(s.pose.x_m - start.x_m, s.pose.y_m - start.y_m) < kSamePlace_m,
  )?.number;
}
