import type { Leg, ModeOption, MotionMode, Plant, Point, Pose, Station, Vehicle } from "@/shared/api/types";
import type { MapOverlays, SweptArea } from "@/shared/map";
import { placed } from "@/shared/math/geometry";
import { clearanceLine, nearestBody } from "./clearance";
import { joined } from "./moveWords";
import { dimension, turnArc, wayOf } from "./moveGeometry";

export interface PreviewInput {
  plant: Plant;
  vehicle: Vehicle | undefined;
  station: Station | undefined;
  /** The chosen mode's, when it is feasible. */
  option: ModeOption | undefined;
  /** All modes that lead there. */
  options: readonly ModeOption[];
  /** The mode that the person looks at in the list. */
  looked: MotionMode | undefined;
  /** The drive under way, drawn instead of a preview. */
  leg?: Leg | undefined;
  /** Where the previewed move begins, when that is not where the vehicle stands. */
  from?: Pose | undefined;
  /** The others, one of which may be what the move comes nearest to. */
  others?: readonly Vehicle[];
  picking: boolean;
}

const kMostTurnArc_m = 3.6;
const kNamedTurn_rad = 0.5 * (Math.PI / 180);

/** Dashes in px that tell the outlines apart; the chosen mode has its hatching instead. */
export const dashes: Record<MotionMode, readonly number[]> = {
  auto: [],
  linear: [],
  fixed_axis_rotation: [9, 4],
  self_rotation: [2, 3],
  lateral: [12, 3, 2, 3],
  oblique: [5, 3],
  combined: [12, 3, 2, 3, 2, 3],
  free: [1, 5],
};

export function isLoaded(vehicle: Vehicle | undefined): boolean {
  return vehicle !== undefined && (vehicle.load_kg > 0 || vehicle.load_name !== "");
}

/** Whether this vehicle may stop at the station. */
export function fits(station: Station, vehicle: Vehicle | undefined): boolean {
  return (
    vehicle === undefined ||
    station.vehicle_types.length === 0 ||
    station.vehicle_types.includes(vehicle.type)
  );
}

const layers: readonly SweptArea["look"][] = ["other", "looked", "chosen"];

export function areasOf({ options, option, looked }: Pick<PreviewInput, "options" | "option" | "looked">) {
  const look = (o: ModeOption): SweptArea["look"] =>
    o.mode === option?.mode ? "chosen" : o.mode === looked ? "looked" : "other";
  return options
    .map((o) => ({ mode: o.mode, rings: o.swept ?? [], look: look(o), dash: dashes[o.mode] }))
    .sort((a, b) => layers.indexOf(a.look) - layers.indexOf(b.look));
}

/** The previewed move as the map lays it over the hall, and the points it is about. */
export function previewOf(
  input: PreviewInput,
  words: { metres: (m: number) => string; degrees: (rad: number) => string },
): { overlays: MapOverlays; about: Point[] | undefined } {
  const { plant, vehicle, station, option, options, leg, from, picking } = input;
  const type = plant.vehicle_types.find((v) => v.id === vehicle?.type);
  const segments = leg ? [] : (option?.segments ?? []);
  const end = segments.at(-1)?.end ?? (option || leg ? station?.pose : undefined);
  const way = leg ? [] : wayOf(segments);
  const dim = dimension(way, option?.swept ?? []);
  const nearest = leg ? undefined : nearestBody(option?.nearest, input.others ?? [], plant, vehicle?.hall);
  const clearance = nearest && clearanceLine(option?.swept ?? [], nearest);
  const turn = joined(segments)
    .reverse()
    .find((s) => s.kind === "rotate" && Math.abs(s.turn_rad) > kNamedTurn_rad);
  const nose = Math.max(0, ...(type?.footprint ?? []).map((p) => p.x_m));
  const overlays: MapOverlays = {
    areas: leg ? [] : areasOf(input),
    ...(way.length > 1 && { path: way }),
    ...(!leg && option?.marker_chain && { chain: option.marker_chain }),
    ...(end && type && { ghost: { pose: end, type: type.id, loaded: isLoaded(vehicle) } }),
    ...(station && { target: station.id }),
    ...(dim &&
      option?.length_m !== undefined && { dimension: { ...dim, text: words.metres(option.length_m) } }),
    ...(clearance &&
      option?.clearance_m !== undefined && {
        clearance: { ...clearance, extensions: [], text: words.metres(option.clearance_m) },
      }),
    ...(turn && {
      turn: {
        points: turnArc(turn, Math.min(kMostTurnArc_m, 0.8 * nose)),
        text: words.degrees(turn.turn_rad),
      },
    }),
    ...(vehicle &&
      !leg && { choosable: new Set(plant.stations.filter((s) => fits(s, vehicle)).map((s) => s.id)) }),
  };
  if (picking || station === undefined) return { overlays, about: undefined };
  const bodies = type ? [type.footprint, ...(isLoaded(vehicle) ? [type.load_footprint] : [])] : [];
  const at = (pose: Station["pose"] | undefined) => (pose ? bodies.flatMap((b) => placed(b, pose)) : []);
  // All areas are in view, so that the window stays when another mode is chosen.
  const about = [
    ...options.flatMap((o) => o.swept ?? []).flat(),
    ...at(end ?? station.pose),
    ...at(from),
    ...(leg ? leg.path : from && vehicle?.leg ? vehicle.leg.path : at(vehicle?.pose)),
    ...(dim ? [dim.from, dim.to] : []),
  ];
  return { overlays, about };
}
