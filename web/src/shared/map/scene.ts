import type {
  Area,
  Closure,
  Hall,
  Marker,
  MarkerChain,
  Plant,
  Point,
  Pose,
  Ring,
  Station,
  StationState,
  Reflector,
  Transmitter,
  Vehicle,
  VehicleType,
} from "@/shared/api/types";
import { boxOf, type Box } from "@/shared/math/geometry";
import { gatesOf, type Gate } from "./gates";
import type { AlarmKind } from "@/shared/live/attention";
import type { LivePose } from "@/shared/live/store";

export interface SweptArea {
  rings: readonly Ring[];
  look: "chosen" | "looked" | "other";
  /** Tells the outlines of the others apart. */
  dash: readonly number[];
}

/** Where the line of a dimension and its two extension lines run, and what it says. */
export interface Dimension {
  from: Point;
  to: Point;
  extensions: readonly (readonly Point[])[];
  text: string;
}

/** What a page lays over the hall: the preview of a move. */
export interface MapOverlays {
  /** Outlines of platform and load all along the move, one a way to drive it; the chosen one last. */
  areas?: readonly SweptArea[];
  /** The line the vehicle's centre takes. */
  path?: readonly Point[];
  /** Codes that the move relies on. */
  chain?: MarkerChain;
  /** Outline of a vehicle of `type`, with its load if it carries one, where the move ends. */
  ghost?: { pose: Pose; type: string; loaded?: boolean };
  /** A length beside a straight drive. */
  dimension?: Dimension;
  /** From what the move sweeps to what it comes nearest to. */
  clearance?: Dimension;
  /** Arc of a turn on the spot and its angle in words. */
  turn?: { points: readonly Point[]; text: string };
  /** Station the move leads to. */
  target?: string;
  /** Places to point out, e.g. where the clearance is least. */
  marks?: readonly Point[];
  /** Stations that can be chosen; the others are drawn faint. Absent: all. */
  choosable?: ReadonlySet<string>;
  /** Floor a person is about to close. */
  closing?: Pick<Closure, "outline" | "edges"> & { corner?: Point };
}

export interface MapLayers {
  roadmap: boolean;
  markers: boolean;
  labels: boolean;
  rulers: boolean;
}
export const allLayers: MapLayers = { roadmap: true, markers: true, labels: true, rulers: true };

/** A line of the roadmap; one for the two edges of a pair. */
export interface Lane {
  ax: number;
  ay: number;
  bx: number;
  by: number;
  big: boolean;
  oneWay: boolean;
  edges: readonly string[];
}

export interface Bracket {
  l: number;
  w: number;
  big: boolean;
  /** Outline of what the vehicle it is drawn for carries. */
  load?: Ring;
}

/** The plant as the renderer wants it: one hall, look-ups made once. */
export interface HallModel {
  hall: Hall;
  box: Box;
  areas: readonly Area[];
  stations: readonly Station[];
  markers: readonly Marker[];
  transmitters: readonly Transmitter[];
  reflectors: readonly Reflector[];
  types: ReadonlyMap<string, VehicleType>;
  typeOf: ReadonlyMap<string, string>;
  /** Where each vehicle is at home, for those at home in this hall. */
  homeOf: ReadonlyMap<string, Pose>;
  lanes: readonly Lane[];
  gates: readonly Gate[];
  /** Half length and half width of the bracket drawn at a station. */
  bracket: ReadonlyMap<string, Bracket>;
}

const kBigM = 6;

function bracketOf(station: Station, plant: Plant): Bracket {
  const fits = plant.vehicle_types.filter(
    (type) => station.vehicle_types.length === 0 || station.vehicle_types.includes(type.id),
  );
  // A station open to all is drawn for the smallest: it shows a place, not a size.
  const half: Omit<Bracket, "big">[] = fits.map((type) => {
    const b = boxOf(type.footprint);
    const load = type.load_footprint.length > 2 ? { load: type.load_footprint } : {};
    return { l: (b.maxX - b.minX) / 2, w: (b.maxY - b.minY) / 2, ...load };
  });
  half.sort((a, b) => (station.vehicle_types.length === 1 ? b.l - a.l : a.l - b.l));
  const one = half[0] ?? { l: 1.3, w: 0.8 };
  return { ...one, big: one.l * 2 > kBigM };
}

export function hallModel(plant: Plant, hallId?: string): HallModel | undefined {
  const hall = plant.halls.find((h) => h.id === hallId) ?? plant.halls[0];
  if (hall === undefined) return undefined;
  const nodes = new Map(plant.roadmap.nodes.filter((n) => n.hall === hall.id).map((n) => [n.id, n.position]));
  const bigTypes = new Set(
    plant.vehicle_types
      .filter((type) => {
        const b = boxOf(type.footprint);
        return b.maxX - b.minX > kBigM;
      })
      .map((type) => type.id),
  );
  const edges = new Map(plant.roadmap.edges.map((e) => [`${e.from}>${e.to}`, e.id]));
  const lanes: Lane[] = [];
  for (const edge of plant.roadmap.edges) {
    const a = nodes.get(edge.from);
    const b = nodes.get(edge.to);
    if (a === undefined || b === undefined) continue;
    const back = edges.get(`${edge.to}>${edge.from}`);
    if (back !== undefined && edge.from > edge.to) continue; // one line for the pair
    const only = edge.vehicle_types ?? [];
    const big = only.length > 0 && only.every((type) => bigTypes.has(type));
    lanes.push({
      ax: a.x_m,
      ay: a.y_m,
      bx: b.x_m,
      by: b.y_m,
      big,
      oneWay: back === undefined,
      edges: [edge.id, ...(back === undefined ? [] : [back])],
    });
  }
  const here = <T extends { hall: string }>(items: readonly T[]) =>
    items.filter((item) => item.hall === hall.id);
  const stations = here(plant.stations);
  return {
    hall,
    box: boxOf(hall.outline),
    areas: here(plant.areas),
    stations,
    markers: here(plant.markers),
    transmitters: here(plant.transmitters ?? []),
    reflectors: here(plant.reflectors ?? []),
    types: new Map(plant.vehicle_types.map((type) => [type.id, type])),
    typeOf: new Map(plant.vehicles.map((v) => [v.id, v.type])),
    homeOf: new Map(
      plant.vehicles.flatMap((v) => {
        const home = stations.find((s) => s.id === v.home);
        return home === undefined ? [] : [[v.id, home.pose] as const];
      }),
    ),
    lanes,
    gates: gatesOf(here(plant.areas), hall.outline),
    bracket: new Map(stations.map((station) => [station.id, bracketOf(station, plant)])),
  };
}

/** One vehicle as it is drawn in this frame. */
export interface DrawnVehicle {
  vehicle: Vehicle;
  type: VehicleType;
  pose: Pose;
  ageS: number;
  stale: boolean;
  blocked: boolean;
  critical: boolean;
  alarm: AlarmKind | undefined;
  /** The selected one waits for it, or for one that waits for it. */
  blocker: boolean;
  waiting: boolean;
  /** A person drives it by hand. */
  inHand: boolean;
  moving: boolean;
  loaded: boolean;
  selected: boolean;
}

export interface LiveInput {
  vehicles: ReadonlyMap<string, Vehicle>;
  stations: ReadonlyMap<string, StationState>;
  poses: ReadonlyMap<string, LivePose>;
  closures: readonly Closure[];
  linkLost: boolean;
}
