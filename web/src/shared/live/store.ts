import type {
  Closure,
  Fleet,
  JobOrder,
  Pose,
  StationState,
  StopRecord,
  StreamFrame,
  Vehicle,
} from "@/shared/api/types";
import { sinceSeen, type Since } from "./since";

/** State of the browser's own link to the server. */
export type LinkState =
  | { kind: "connecting" }
  | { kind: "live"; heardAt: number }
  | { kind: "lost"; since: number; heardAt: number | undefined };

/** Newest pose of one vehicle. Times are performance.now() milliseconds of this browser. */
export interface LivePose extends Pose {
  speed_mps: number;
  /** When the server heard it, in this browser's clock. */
  heardAt: number;
}

/** All that the screens show, replaced as a whole part on change so that selectors compare by identity. */
export interface LiveState {
  link: LinkState;
  ready: boolean;
  fleet: Fleet | undefined;
  vehicles: ReadonlyMap<string, Vehicle>;
  stations: ReadonlyMap<string, StationState>;
  jobOrders: ReadonlyMap<string, JobOrder>;
  stopRecords: ReadonlyMap<string, StopRecord>;
  /** Floor that people have closed, oldest first. */
  closures: readonly Closure[];
  /** Goes up when floor may have been closed or opened: `closures` is asked for again. */
  floorTurn: number;
  /** Goes up when something about loads may have changed: they are asked for again. */
  loadsTurn: number;
  /** Goes up when a stop may have gone unmeasured: such stops are asked for again. */
  unmeasuredTurn: number;
  /** Server clock minus browser clock, ms; ages of server times are computed with it. */
  clockOffsetMs: number;
  /** Since when each vehicle does what it does, as far as this page has seen it. */
  since: ReadonlyMap<string, Since>;
}

export const emptyState: LiveState = {
  link: { kind: "connecting" },
  ready: false,
  fleet: undefined,
  vehicles: new Map(),
  stations: new Map(),
  jobOrders: new Map(),
  stopRecords: new Map(),
  closures: [],
  floorTurn: 0,
  loadsTurn: 0,
  unmeasuredTurn: 0,
  clockOffsetMs: 0,
  since: new Map(),
};

const kMaxStopRecords = 500;

const byKey = <T>(items: readonly T[], key: (item: T) => string) => new Map(items.map((i) => [key(i), i]));

function withItem<T>(map: ReadonlyMap<string, T>, key: string, item: T): ReadonlyMap<string, T> {
  return new Map(map).set(key, item);
}

function withStop(map: ReadonlyMap<string, StopRecord>, stop: StopRecord): ReadonlyMap<string, StopRecord> {
  if (map.has(stop.id)) return withItem(map, stop.id, stop);
  const next = new Map([[stop.id, stop], ...map]);
  for (const key of [...next.keys()].slice(kMaxStopRecords)) next.delete(key);
  return next;
}

function withSince(state: LiveState, v: Vehicle, nowMs: number): LiveState["since"] {
  const known = state.since.get(v.id);
  const since = sinceSeen(known, v, nowMs, known !== undefined);
  return since === known ? state.since : withItem(state.since, v.id, since);
}

function isNewer(old: JobOrder | undefined, next: JobOrder): boolean {
  return old === undefined || next.revision >= old.revision;
}

/** One frame into the state. Pure. Poses are kept apart (see LiveStore) and change nothing here. */
export function reduce(state: LiveState, frame: StreamFrame, wallMs: number): LiveState {
  switch (frame.type) {
    case "snapshot": {
      const serverMs = Date.parse(frame.server_time);
      return {
        ...state,
        ready: true,
        floorTurn: state.floorTurn + 1,
        loadsTurn: state.loadsTurn + 1,
        unmeasuredTurn: state.unmeasuredTurn + 1,
        fleet: frame.fleet,
        vehicles: byKey(frame.vehicles, (v) => v.id),
        stations: byKey(frame.stations, (s) => s.station),
        jobOrders: byKey(frame.job_orders, (o) => o.id),
        stopRecords: byKey(frame.stop_records, (r) => r.id),
        clockOffsetMs: serverMs - wallMs || 0,
        since: new Map(
          frame.vehicles.map((v) => [v.id, sinceSeen(state.since.get(v.id), v, serverMs, false)]),
        ),
      };
    }
    case "vehicle":
      return {
        ...state,
        vehicles: withItem(state.vehicles, frame.vehicle.id, frame.vehicle),
        since: withSince(state, frame.vehicle, wallMs + state.clockOffsetMs),
      };
    case "station":
      return { ...state, stations: withItem(state.stations, frame.station.station, frame.station) };
    case "job_order":
      if (!isNewer(state.jobOrders.get(frame.job_order.id), frame.job_order)) return state;
      return { ...state, jobOrders: withItem(state.jobOrders, frame.job_order.id, frame.job_order) };
    case "stop_record":
      return { ...state, stopRecords: withStop(state.stopRecords, frame.stop_record) };
    case "fleet":
      return { ...state, fleet: frame.fleet };
    case "changes":
      return frame.changes.reduce((next, change) => reduce(next, change, wallMs), state);
    case "event":
      if (frame.event.type.startsWith("floor.")) return { ...state, floorTurn: state.floorTurn + 1 };
      if (frame.event.type.startsWith("load.")) return { ...state, loadsTurn: state.loadsTurn + 1 };
      if (frame.event.type !== "stop.not_measured") return state;
      return { ...state, unmeasuredTurn: state.unmeasuredTurn + 1 };
    case "poses":
      return state;
  }
}

type PoseRow = [string, number, number, number, number, number];

function isPoseRow(row: unknown): row is PoseRow {
  return (
    Array.isArray(row) &&
    row.length >= 6 &&
    typeof row[0] === "string" &&
    row.slice(1, 6).every((n) => typeof n === "number" && Number.isFinite(n))
  );
}

/**
 * The one store of live data. React reads parts of `state` through selectors; poses live in a plain map that
 * the canvas reads on its own, because ten changes a second and vehicle are no business of React's.
 * Listeners hear at most once per animation frame.
 */
export class LiveStore {
  readonly poses = new Map<string, LivePose>();
  private current: LiveState = emptyState;
  private pending: LiveState = emptyState;
  private listeners = new Set<() => void>();
  private poseListeners = new Set<() => void>();
  private scheduled = false;
  private posesDirty = false;

  constructor(
    private readonly schedule: (flush: () => void) => void = (flush) => requestAnimationFrame(() => flush()),
    private readonly clock: () => number = () => performance.now(),
    private readonly wall: () => number = () => Date.now(),
  ) {}

  get state(): LiveState {
    return this.current;
  }

  subscribe = (listener: () => void): (() => void) => {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  };

  /** Heard once per animation frame in which poses came in. */
  subscribePoses = (listener: () => void): (() => void) => {
    this.poseListeners.add(listener);
    return () => this.poseListeners.delete(listener);
  };

  apply(frame: StreamFrame): void {
    if (frame.type === "poses") {
      this.takePoses(frame.poses);
      return;
    }
    if (frame.type === "changes") {
      for (const change of frame.changes) if (change.type === "poses") this.takePoses(change.poses);
    }
    if (frame.type === "snapshot") this.takeSnapshotPoses(frame.vehicles, Date.parse(frame.server_time));
    this.pending = reduce(this.pending, frame, this.wall());
    this.request();
  }

  setLink(link: LinkState): void {
    this.pending = { ...this.pending, link };
    this.request();
  }

  setClosures(closures: readonly Closure[]): void {
    this.pending = { ...this.pending, closures };
    this.request();
  }

  /** Forgets everything, at sign-out. */
  clear(): void {
    this.poses.clear();
    this.pending = emptyState;
    this.posesDirty = true;
    this.request();
  }

  private takePoses(rows: readonly unknown[]): void {
    const now = this.clock();
    for (const row of rows) {
      if (!isPoseRow(row)) continue;
      const [id, x_m, y_m, heading_rad, speed_mps, age_s] = row;
      this.poses.set(id, { x_m, y_m, heading_rad, speed_mps, heardAt: now - age_s * 1000 });
    }
    this.posesDirty = true;
    this.request();
  }

  private takeSnapshotPoses(vehicles: readonly Vehicle[], serverMs: number): void {
    const now = this.clock();
    this.poses.clear();
    for (const v of vehicles) {
      if (v.pose === undefined) continue;
      const at = v.pose_at ?? v.last_heard_at;
      const age = at === undefined ? Infinity : Math.max(0, serverMs - Date.parse(at));
      this.poses.set(v.id, { ...v.pose, speed_mps: v.speed_mps ?? 0, heardAt: now - age });
    }
    this.posesDirty = true;
  }

  private request(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    this.schedule(() => this.flush());
  }

  private flush(): void {
    this.scheduled = false;
    if (this.posesDirty) {
      this.posesDirty = false;
      for (const listener of this.poseListeners) listener();
    }
    if (this.pending === this.current) return;
    this.current = this.pending;
    for (const listener of this.listeners) listener();
  }
}

export const liveStore = new LiveStore();
