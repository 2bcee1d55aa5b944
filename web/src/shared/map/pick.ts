import Flatbush from "flatbush";
import { distanceToRing, placed, type MetricPoint } from "@/shared/math/geometry";
import type { DrawnVehicle, HallModel } from "./scene";

export type Picked =
  | { kind: "vehicle"; id: string }
  | { kind: "station"; id: string; number: number }
  | { kind: "point"; point: MetricPoint; reach_m: number };

/** Finger width around a thing, in screen pixels. */
const kReachPx = 14;

/** Finds what lies under a press. Stations are indexed once per hall, vehicles move and are few in reach. */
export class Picker {
  private readonly index: Flatbush | undefined;

  constructor(private readonly model: HallModel) {
    const { stations } = model;
    if (stations.length === 0) return;
    this.index = new Flatbush(stations.length);
    for (const station of stations) {
      const { l, w } = model.bracket.get(station.id) ?? { l: 1, w: 1 };
      const c = Math.abs(Math.cos(station.pose.heading_rad));
      const s = Math.abs(Math.sin(station.pose.heading_rad));
      const hw = l * c + w * s;
      const hh = l * s + w * c;
      const { x_m, y_m } = station.pose;
      this.index.add(x_m - hw, y_m - hh, x_m + hw, y_m + hh);
    }
    this.index.finish();
  }

  /** `prefer` decides where a vehicle stands on a station. */
  pick(
    point: MetricPoint,
    pxPerM: number,
    vehicles: readonly DrawnVehicle[],
    prefer: "vehicle" | "station" | "point",
  ): Picked {
    const reach = kReachPx / pxPerM;
    if (prefer === "point") return { kind: "point", point, reach_m: reach };
    const station = this.station(point, reach);
    const vehicle = nearestVehicle(point, reach, vehicles);
    if (prefer === "station" && station !== undefined) return station;
    if (vehicle !== undefined) return { kind: "vehicle", id: vehicle };
    return station ?? { kind: "point", point, reach_m: reach };
  }

  private station(point: MetricPoint, reach: number): Picked | undefined {
    if (this.index === undefined) return undefined;
    const found = this.index
      .search(point.x_m - reach, point.y_m - reach, point.x_m + reach, point.y_m + reach)
      .map((i) => this.model.stations[i]!)
      .map((s) => ({ s, d: Math.hypot(s.pose.x_m - point.x_m, s.pose.y_m - point.y_m) }))
      .sort((a, b) => a.d - b.d)[0];
    return found && { kind: "station", id: found.s.id, number: found.s.number };
  }
}

function nearestVehicle(
  point: MetricPoint,
  reach: number,
  vehicles: readonly DrawnVehicle[],
): string | undefined {
  let best = reach;
  let id: string | undefined;
  for (const v of vehicles) {
    const ring = placed(v.type.footprint, v.pose).map((p) => ({ x: p.x_m, y: p.y_m }));
    const d = distanceToRing(ring, { x: point.x_m, y: point.y_m });
    if (d < best) {
      best = d;
      id = v.vehicle.id;
    }
  }
  return id;
}
