import type { Plant, Point, Pose, Ring, Station, Vehicle, VehicleType } from "@/shared/api/types";
import { linePath, placed, ringPath, stationFrame, type Dimension } from "./previewView";

// What stands in the preview's map. Arrow heads keep their size on the screen: `unit` is how many
// metres 24 px are.

export function isLoaded(vehicle: Vehicle | undefined): boolean {
  return vehicle !== undefined && (vehicle.load_kg > 0 || vehicle.load_name !== "");
}

/** Corner brackets about those who stop at the station. */
export function StationMark({ plant, station }: { plant: Plant; station: Station }) {
  const { pose } = station;
  const deg = (pose.heading_rad * 180) / Math.PI;
  const { x_m: x, y_m: y } = stationFrame(plant, station);
  const arm = Math.min(0.6, y / 3);
  const corner = (sx: number, sy: number) => `M${sx * x} ${sy * (y - arm)}V${sy * y}H${sx * (x - arm)}`;
  return (
    <path
      className="stn"
      transform={`translate(${pose.x_m} ${pose.y_m}) rotate(${deg})`}
      d={`${corner(-1, -1)}${corner(1, -1)}${corner(1, 1)}${corner(-1, 1)}M-.5 0H.5M0 -.5V.5`}
    />
  );
}

export function Body({ vehicle, plant, selected }: { vehicle: Vehicle; plant: Plant; selected?: boolean }) {
  const type = plant.vehicle_types.find((v) => v.id === vehicle.type);
  if (!type || !vehicle.pose) return null;
  const pose = vehicle.pose;
  const nose = Math.max(...type.footprint.map((p) => p.x_m));
  const arrow = Math.min(1, nose * 0.4);
  const stale = vehicle.link !== "live";
  return (
    <g className={selected ? "sel" : stale ? "stl" : ""}>
      {isLoaded(vehicle) && type.load_footprint.length > 2 && (
        <path className={`load ${selected ? "sel" : ""}`} d={ringPath([placed(type.load_footprint, pose)])} />
      )}
      <path className="veh-b" d={ringPath([placed(type.footprint, pose)])} />
      <path
        className="veh-h"
        transform={`translate(${pose.x_m} ${pose.y_m}) rotate(${(pose.heading_rad * 180) / Math.PI})`}
        d={`M${nose - 0.3} 0L${nose - 0.3 - arrow} ${arrow * 0.65}L${nose - 0.3 - arrow * 0.7} 0L${nose - 0.3 - arrow} ${-arrow * 0.65}Z`}
      />
    </g>
  );
}

/** Where the vehicle will stand: its outline, then those of its load. */
export function GhostBody({
  type,
  end,
  outlines,
}: {
  type: VehicleType;
  end: Pose;
  outlines: readonly Ring[];
}) {
  const nose = Math.max(...type.footprint.map((p) => p.x_m));
  const k = Math.min(1, nose / 3);
  const deg = (end.heading_rad * 180) / Math.PI;
  const [body, ...loads] = outlines;
  return (
    <>
      {loads.length > 0 && <path className="ghost" d={ringPath(loads)} />}
      {body && <path className="goal" d={ringPath([body])} />}
      <path
        className="goal"
        transform={`translate(${end.x_m} ${end.y_m}) rotate(${deg})`}
        d={`M${nose - 1.8 * k} ${-0.62 * k}L${nose - 0.8 * k} 0L${nose - 1.8 * k} ${0.62 * k}`}
      />
    </>
  );
}

export function TurnArc({ points, unit }: { points: readonly Point[]; unit: number }) {
  const tip = points[points.length - 1];
  const before = points[Math.max(0, points.length - 3)];
  if (!tip || !before) return null;
  const angle = (Math.atan2(tip.y_m - before.y_m, tip.x_m - before.x_m) * 180) / Math.PI;
  return (
    <>
      <path className="prevline solid" d={linePath(points)} />
      <path
        className="granthead"
        transform={`translate(${tip.x_m} ${tip.y_m}) rotate(${angle}) scale(${unit})`}
        d="M.35 0L-.55 .4V-.4Z"
      />
    </>
  );
}

/** Extension lines, dimension line and its two arrow heads. */
export function DimensionLine({ dim, unit }: { dim: Dimension; unit: number }) {
  const angle = (Math.atan2(dim.to.y_m - dim.from.y_m, dim.to.x_m - dim.from.x_m) * 180) / Math.PI;
  const head = (p: Point, turn: number) =>
    `translate(${p.x_m} ${p.y_m}) rotate(${angle + turn}) scale(${unit})`;
  return (
    <>
      <path
        className="dim"
        d={linePath(dim.extensions[0]) + linePath(dim.extensions[1]) + linePath([dim.from, dim.to])}
      />
      <path className="dimh" transform={head(dim.from, 0)} d="M0 0l.6 .2v-.4z" />
      <path className="dimh" transform={head(dim.to, 180)} d="M0 0l.6 .2v-.4z" />
    </>
  );
}
