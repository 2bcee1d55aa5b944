import type { Plant, Pose, Station } from "@/shared/api/types";

/** In (-pi, pi]. */
const wrap = (angle_rad: number) => angle_rad - 2 * Math.PI * Math.ceil(angle_rad / (2 * Math.PI) - 0.5);

/** Where a station is for somebody who stands on the vehicle and looks ahead. */
export interface Way {
  station: Station;
  distance_m: number;
  ahead_m: number;
  left_m: number;
  /** To turn, counter-clockwise. */
  turn_rad: number;
}

export function wayTo(station: Station, pose: Pose): Way {
  const dx = station.pose.x_m - pose.x_m;
  const dy = station.pose.y_m - pose.y_m;
  const [c, s] = [Math.cos(pose.heading_rad), Math.sin(pose.heading_rad)];
  return {
    station,
    distance_m: Math.hypot(dx, dy),
    ahead_m: c * dx + s * dy,
    left_m: c * dy - s * dx,
    turn_rad: wrap(station.pose.heading_rad - pose.heading_rad),
  };
}

/** The stations of its hall that it may stand at, the nearest first. */
export function nearest(plant: Plant, hall: string, type: string, pose: Pose, count: number): Way[] {
  return plant.stations
    .filter((s) => s.hall === hall && (s.vehicle_types.length === 0 || s.vehicle_types.includes(type)))
    .map((station) => wayTo(station, pose))
    .sort((a, b) => a.distance_m - b.distance_m)
    .slice(0, count);
}
