import type { JobOrder, Station, Vehicle } from "@/shared/api/types";
import { alarmOf, groupOf, onFeet, type Group, kGroups } from "@/shared/live/attention";
import { haltOf } from "@/shared/live/pause";

export interface GroupedRows {
  group: Group;
  vehicles: readonly Vehicle[];
}

const kRank = { critical: 0, high: 1, low: 2 } as const;
const rank = (v: Vehicle) => kRank[alarmOf(v)?.priority ?? "low"] + (alarmOf(v) === undefined ? 0.5 : 0);
const byUrgency = (a: Vehicle, b: Vehicle) => rank(a) - rank(b);

/** The list's groups in order, empty ones left out. */
export function grouped(vehicles: readonly Vehicle[], find: string): GroupedRows[] {
  const wanted = find.trim().toLowerCase();
  const shown = vehicles.filter((v) => wanted === "" || v.name.toLowerCase().includes(wanted));
  return kGroups
    .map((group) => ({ group, vehicles: shown.filter((v) => groupOf(v) === group).sort(byUrgency) }))
    .filter((rows) => rows.vehicles.length > 0);
}

/** Stations whose number or name is asked for; none while nothing is asked. */
export function foundStations<T extends Station>(stations: readonly T[], find: string): T[] {
  const wanted = find.trim().toLowerCase();
  if (wanted === "") return [];
  return stations
    .filter(
      (s) => String(s.number) === wanted || (wanted.length > 1 && s.name.toLowerCase().includes(wanted)),
    )
    .slice(0, 8);
}

/** What a vehicle does, as a key of the catalog with its values; the caller puts it into words. */
export interface What {
  key: string;
  values: Record<string, string | number>;
}

export function whatOf(
  v: Vehicle,
  numberOf: (station: string) => string | undefined,
  order?: JobOrder,
): What {
  const at = v.at_station ? numberOf(v.at_station) : undefined;
  const to = v.leg && numberOf(v.leg.station);
  if (v.link === "never") return { key: "never", values: {} };
  if (haltOf(v) === "stopping") return { key: "stopping", values: {} };
  if (v.activity === "paused") return { key: "paused", values: {} };
  if (v.activity === "measuring") return { key: "measuring", values: { station: to ?? at ?? "" } };
  if (to !== undefined) {
    const before = order?.steps[order.current_step - 1]?.number;
    return before === undefined
      ? { key: "to", values: { station: to } }
      : { key: "from_to", values: { from: before, to } };
  }
  if (v.activity === "charging") {
    const percent = Math.round(v.battery_percent);
    return at === undefined
      ? { key: "charging_between", values: { percent } }
      : { key: "charging", values: { station: at, percent } };
  }
  if (at === undefined) return { key: "between", values: {} };
  if (onFeet(v)) return { key: "on_feet", values: { station: at } };
  return { key: "at", values: { station: at } };
}

const kOpen = new Set<JobOrder["state"]>(["NotAllowedToStart", "AllowedToStart", "Running", "Interrupted"]);
const kOrder: Record<JobOrder["state"], number> = {
  Running: 0,
  Interrupted: 1,
  AllowedToStart: 2,
  NotAllowedToStart: 3,
  Ended: 4,
  Aborted: 5,
};

/** Open orders: those under way first, then by priority and age. */
export function openOrders(orders: readonly JobOrder[]): JobOrder[] {
  return orders
    .filter((o) => kOpen.has(o.state))
    .sort((a, b) => kOrder[a.state] - kOrder[b.state] || b.priority - a.priority || a.number - b.number);
}

/** Share of an order that is done: finished steps and the drive under way. */
export function orderProgress(order: JobOrder, leg: Vehicle["leg"]): number {
  const done = order.steps.filter((s) => s.state === "done" || s.state === "skipped").length;
  const now = order.steps[order.current_step];
  const part = leg !== undefined && now?.leg === leg.id ? leg.progress : 0;
  return order.steps.length === 0 ? 0 : Math.min(1, (done + part) / order.steps.length);
}
