import type { JobOrder, Station, Vehicle } from "@/shared/api/types";
import { alarmOf, groupOf, onFeet, type Group, kGroups } from "@/shared/live/attention";
import { haltOf } from "@/shared/live/pause";
import { sinceOf, type Since } from "@/shared/live/since";
import { expectedIn } from "@/shared/words/expected";

export interface GroupedRows {
  group: Group;
  vehicles: readonly Vehicle[];
}

const kRank = { critical: 0, high: 1, low: 2 } as const;
const rank = (v: Vehicle) => kRank[alarmOf(v)?.priority ?? "low"] + (alarmOf(v) === undefined ? 0.5 : 0);

/**
 * The list's groups in order, empty ones left out. In each the most urgent come first, and of those that wait the one
 * that has waited longest; both change seldom, so that no row moves under a finger. The rest keeps the order it has.
 */
export function grouped(
  vehicles: readonly Vehicle[],
  find: string,
  since: ReadonlyMap<string, Since> = new Map(),
): GroupedRows[] {
  const wanted = find.trim().toLowerCase();
  const shown = vehicles.filter((v) => wanted === "" || v.name.toLowerCase().includes(wanted));
  const began = (v: Vehicle) => sinceOf(v, since.get(v.id))?.atMs ?? Infinity;
  const longest = (a: Vehicle, b: Vehicle) => (began(a) === began(b) ? 0 : began(a) - began(b));
  const order: Partial<Record<Group, (a: Vehicle, b: Vehicle) => number>> = {
    attention: (a, b) => rank(a) - rank(b) || longest(a, b),
    waiting: longest,
  };
  return kGroups
    .map((group) => {
      const own = shown.filter((v) => groupOf(v) === group);
      return { group, vehicles: order[group] ? own.sort(order[group]) : own };
    })
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

export type LegPurpose = "order" | "makes_way" | "charge" | "aside";
/** Going aside and its drive begin at one time, but not in one message. */
const kTogetherMs = 2000;

/** What a drive is for. One without an order is told by its reason, or by when the vehicle last went aside. */
export function legPurpose(v: Vehicle, order?: JobOrder): LegPurpose {
  const { leg } = v;
  if (leg === undefined || order?.steps.some((s) => s.leg === leg.id)) return "order";
  if (v.reason?.code === "makes_way") return "makes_way";
  if (v.reason?.code === "goes_charging") return "charge";
  if (v.order !== undefined && order === undefined) return "order"; // its order has yet to come in
  const last = v.made_way?.at(-1);
  const asideMs = last === undefined ? NaN : Date.parse(last);
  const startedMs = leg.started_at === undefined ? NaN : Date.parse(leg.started_at);
  return Math.abs(asideMs - startedMs) <= kTogetherMs ? "makes_way" : "aside";
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
    const purpose = legPurpose(v, order);
    if (purpose !== "order") return { key: purpose, values: { station: to } };
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
const isLate = (order: JobOrder, nowMs: number) =>
  [order.expected_at, order.due].some((at) => expectedIn(at, nowMs).kind === "late");

/** 0: a person has to act; 1: late; 2: under way; 3: waits for a vehicle; 4: held. */
function urgency(order: JobOrder, nowMs: number): number {
  if (order.state === "Interrupted") return 0;
  if (isLate(order, nowMs)) return 1;
  return order.state === "Running" ? 2 : order.state === "AllowedToStart" ? 3 : 4;
}

/** Open orders, most urgent first; of equal ones by priority, then the one that is due first, then the older one. */
export function openOrders(orders: readonly JobOrder[], nowMs: number): JobOrder[] {
  const due = (o: JobOrder) => (o.due === undefined ? Infinity : Date.parse(o.due));
  return orders
    .filter((o) => kOpen.has(o.state) && !o.removed)
    .map((order) => ({ order, urgency: urgency(order, nowMs) }))
    .sort(
      (a, b) =>
        a.urgency - b.urgency ||
        b.order.priority - a.order.priority ||
        (due(a.order) === due(b.order) ? 0 : due(a.order) - due(b.order)) ||
        a.order.number - b.order.number,
    )
    .map(({ order }) => order);
}

/** Share of an order that is done: finished steps and, of the drive under way, what lies behind the vehicle. */
export function orderProgress(order: JobOrder, leg: Vehicle["leg"], driven = leg?.progress ?? 0): number {
  const done = order.steps.filter((s) => s.state === "done" || s.state === "skipped").length;
  const now = order.steps[order.current_step];
  const part = leg !== undefined && now?.leg === leg.id ? driven : 0;
  return order.steps.length === 0 ? 0 : Math.min(1, (done + part) / order.steps.length);
}
