import { useEffect, useRef, useState, type CSSProperties } from "react";
import { useTranslation } from "react-i18next";
import type {
  Leg,
  ModeOption,
  MotionMode,
  Plant,
  Point,
  Pose,
  Ring,
  StationState,
  Vehicle,
  VehicleType,
} from "@/shared/api/types";
import { number } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { joined } from "./moveWords";
import {
  dimension,
  inView,
  linePath,
  nearestStation,
  placed,
  ringPath,
  stationFrame,
  toShare,
  turnArc,
  viewOf,
  wayOf,
  type Dimension,
  type View,
} from "./previewView";
import { Body, DimensionLine, GhostBody, isLoaded, StationMark, TurnArc } from "./PreviewGlyphs";
import { AreasLegend, SweptAreas } from "./SweptAreas";

export interface PreviewMapProps {
  plant: Plant;
  vehicles: readonly Vehicle[];
  states: readonly StationState[];
  vehicle: Vehicle | undefined;
  target: number | undefined;
  /** The chosen mode's, when it is feasible. */
  option: ModeOption | undefined;
  /** All modes that lead there. */
  options: readonly ModeOption[];
  /** The mode that the person looks at in the list. */
  looked: MotionMode | undefined;
  /** The drive under way, drawn instead of a preview. */
  leg?: Leg | undefined;
  /** A press on the map takes the nearest station. */
  picking: boolean;
  onPick: (station: number) => void;
}

const kUnit_px = 24;
const kMostTurnArc_m = 3.6;
const kPick_px = 40;
/** Below this scale plates are bare digits and only the selected vehicle is named. */
const kNear_pxPerM = 8;
const kNamedTurn_rad = 0.5 * (Math.PI / 180);

/** Plan view of the previewed move to scale: swept areas, way, target ghost, dimensions. */
export function PreviewMap(props: PreviewMapProps) {
  const { t } = useTranslation("send");
  const words = useWords();
  const box = useRef<HTMLDivElement>(null);
  const size = useSize(box);
  const scene = sceneOf(props);
  const view = size && viewOf(scene.fit, size.width / size.height, props.picking ? 0.03 : 0.12);
  return (
    <div
      className={`mapbox pmap ${props.picking ? "picking" : ""}`}
      ref={box}
      // The number pad is the way without a pointer.
      onClick={(event) => {
        if (!props.picking || !view || !box.current) return;
        const frame = box.current.getBoundingClientRect();
        const at = {
          x: (event.clientX - frame.left) / frame.width,
          y: (event.clientY - frame.top) / frame.height,
        };
        const hit = nearestStation(props.plant, scene.hall, view, at, kPick_px / frame.width);
        if (hit !== undefined) props.onPick(hit);
      }}
    >
      {view && size && (
        <>
          <svg
            className="m"
            viewBox={`0 0 ${view.width} ${view.height}`}
            role="img"
            aria-label={
              props.options.length > 0
                ? t("preview.map_modes", {
                    modes: props.options.map((o) => words.mode(o.mode)).join(t("words.join")),
                  })
                : t("preview.map")
            }
          >
            <defs>
              <pattern
                id="hsw"
                width={9 / (size.width / view.width)}
                height={9 / (size.width / view.width)}
                patternUnits="userSpaceOnUse"
                patternTransform="rotate(45)"
              >
                <path
                  d={`M0 0V${9 / (size.width / view.width)}`}
                  stroke="var(--swept-hatch)"
                  strokeWidth="2.5"
                />
              </pattern>
            </defs>
            <g transform={`translate(${-view.left} ${view.height + view.bottom}) scale(1 -1)`}>
              <Drawing {...props} scene={scene} unit={(kUnit_px * view.width) / size.width} />
            </g>
          </svg>
          <AreasLegend options={props.options} chosen={props.option} looked={props.looked} />
          <Labels {...props} scene={scene} view={view} near={size.width / view.width >= kNear_pxPerM} />
        </>
      )}
    </div>
  );
}

interface Scene {
  type: VehicleType | undefined;
  ghost: Ring[];
  way: Point[];
  end: Pose | undefined;
  turn: Point[];
  turn_rad: number;
  dim: Dimension | undefined;
  fit: Ring[];
  hall: string | undefined;
}

function sceneOf({ plant, vehicle, target, option, options, leg, picking }: PreviewMapProps): Scene {
  const station = plant.stations.find((s) => s.number === target);
  const type = plant.vehicle_types.find((v) => v.id === vehicle?.type);
  const segments = option?.segments ?? [];
  const end = segments.at(-1)?.end ?? station?.pose;
  const swept = option?.swept ?? [];
  const bodies = type ? [type.footprint, ...(isLoaded(vehicle) ? [type.load_footprint] : [])] : [];
  const ghost = end ? bodies.filter((b) => b.length > 2).map((b) => placed(b, end)) : [];
  const turn = joined(segments)
    .reverse()
    .find((s) => s.kind === "rotate" && Math.abs(s.turn_rad) > kNamedTurn_rad);
  const nose = Math.max(...(type?.footprint ?? []).map((p) => p.x_m));
  const arc_m = Math.min(kMostTurnArc_m, 0.8 * nose);
  const hall = vehicle?.hall ?? station?.hall ?? plant.halls[0]?.id;
  const outline = plant.halls.find((h) => h.id === hall)?.outline ?? [];
  const here = vehicle?.pose;
  const own = here ? bodies.filter((b) => b.length > 2).map((b) => placed(b, here)) : [];
  const way = leg ? leg.path : wayOf(segments);
  const dim = leg ? undefined : dimension(way, swept);
  // All areas are in view, so that the window stays when another mode is chosen.
  const areas = options.flatMap((o) => o.swept ?? []);
  const about = [...areas, ...ghost, ...own, ...(leg ? [leg.path, ...leg.granted_area] : [])];
  if (dim) about.push([dim.from, dim.to]);
  return {
    type,
    ghost,
    way,
    dim,
    end,
    turn: turn ? turnArc(turn, arc_m) : [],
    turn_rad: turn?.turn_rad ?? 0,
    fit: picking || !station || about.length === 0 ? [outline] : about,
    hall,
  };
}

function Drawing({
  plant,
  vehicles,
  vehicle,
  option,
  options,
  looked,
  leg,
  scene,
  unit,
}: PreviewMapProps & { scene: Scene; unit: number }) {
  const hall = plant.halls.find((h) => h.id === scene.hall);
  const areas = plant.areas.filter((a) => a.hall === scene.hall);
  const areaClass = { zone: "zone", lane: "lane", no_go: "zone", obstacle: "wall" } as const;
  const nodes = new Map(plant.roadmap.nodes.map((n) => [n.id, n]));
  const lanes = plant.roadmap.edges.flatMap((e) => {
    const a = nodes.get(e.from);
    const b = nodes.get(e.to);
    return a && b && a.hall === scene.hall ? [linePath([a.position, b.position])] : [];
  });
  return (
    <>
      {hall && <path className="floor" d={ringPath([hall.outline])} />}
      {areas.map((a) => (
        <path key={a.id} className={areaClass[a.kind]} d={ringPath([a.outline])} />
      ))}
      {hall && <path className="grid10" d={gridPath(hall.outline, 10)} />}
      {hall && <path className="hallw" d={ringPath([hall.outline])} />}
      <path className="pfroute" d={lanes.join("")} />
      {plant.stations
        .filter((s) => s.hall === scene.hall)
        .map((s) => (
          <StationMark key={s.id} plant={plant} station={s} />
        ))}
      {vehicles
        .filter((v) => v.id !== vehicle?.id && v.pose && v.hall === scene.hall)
        .map((v) => (
          <Body key={v.id} vehicle={v} plant={plant} />
        ))}
      <SweptAreas options={options} chosen={option} looked={looked} />
      {leg && <path className="grantband" d={ringPath(leg.granted_area)} />}
      {scene.type && scene.end && (option || leg) && (
        <GhostBody type={scene.type} end={scene.end} outlines={scene.ghost} />
      )}
      {vehicle?.pose && <Body vehicle={vehicle} plant={plant} selected />}
      {scene.way.length > 1 && !leg && <path className="prevline" d={linePath(scene.way)} />}
      {leg && <path className="granted" d={linePath(leg.path.slice(0, leg.granted_points))} />}
      {leg && <path className="horizon" d={linePath(leg.path.slice(Math.max(0, leg.granted_points - 1)))} />}
      {scene.dim && <DimensionLine dim={scene.dim} unit={unit} />}
      {scene.turn.length > 1 && <TurnArc points={scene.turn} unit={unit} />}
    </>
  );
}

function gridPath(outline: Ring, step_m: number): string {
  const xs = outline.map((p) => p.x_m);
  const ys = outline.map((p) => p.y_m);
  const [x0, x1] = [Math.min(...xs), Math.max(...xs)];
  const [y0, y1] = [Math.min(...ys), Math.max(...ys)];
  let d = "";
  for (let x = Math.ceil(x0 / step_m) * step_m; x < x1; x += step_m) d += `M${x} ${y0}V${y1}`;
  for (let y = Math.ceil(y0 / step_m) * step_m; y < y1; y += step_m) d += `M${x0} ${y}H${x1}`;
  return d;
}

function Labels(props: PreviewMapProps & { scene: Scene; view: View; near: boolean }) {
  const { plant, vehicles, states, vehicle, target, option, scene, view, near } = props;
  const { t } = useTranslation("send");
  const at = (p: Point): CSSProperties => {
    const s = toShare(view, p);
    return { left: `${s.x * 100}%`, top: `${s.y * 100}%` };
  };
  const stateOf = (id: string) => states.find((s) => s.station === id);
  return (
    <>
      {plant.stations
        .filter((s) => s.hall === scene.hall && inView(view, s.pose))
        .map((s) => {
          const state = stateOf(s.id);
          const look =
            s.number === target ? "goal" : state?.occupied_by ? "occ" : state?.reserved_by ? "res" : "";
          return (
            <span
              key={s.id}
              className={`tag ${near ? "big" : "sm"} ${look}`}
              style={at(near ? plate(s.pose, stationFrame(plant, s), view) : s.pose)}
            >
              {s.number}
            </span>
          );
        })}
      {vehicles
        .filter(
          (v) => v.pose && v.hall === scene.hall && inView(view, v.pose) && (near || v.id === vehicle?.id),
        )
        .map((v) => {
          const own = v.id === vehicle?.id;
          if (!v.pose) return null;
          const below = { x_m: v.pose.x_m, y_m: v.pose.y_m - Math.max(2.6, view.height * 0.06) };
          return (
            <span
              key={v.id}
              className={`vt ${own ? "sel" : v.link === "live" ? "" : "stl"}`}
              style={at(below)}
            >
              {v.name} {v.load_name && <em>{v.load_name}</em>}
            </span>
          );
        })}
      {scene.dim && option?.length_m !== undefined && (
        <span className="lb dimt" style={at(middle(scene.dim))}>
          {t("preview.metres", { value: number(option.length_m, { decimals: 3 }) })}
        </span>
      )}
      {scene.turn.length > 1 && (
        <span className="lb dimt acc" style={at(outside(scene.turn, scene.end))}>
          {number((Math.abs(scene.turn_rad) * 180) / Math.PI, { decimals: 1 })}°
        </span>
      )}
    </>
  );
}

/** The number plate stands off the station's corner, so that it covers no body. */
function plate(pose: Pose, frame: Point, view: View): Point {
  const left = frame.x_m - Math.min(1.2, frame.x_m / 3);
  const up = frame.y_m + Math.max(0.4 * frame.y_m, view.height * 0.035);
  const s = Math.sin(pose.heading_rad);
  const c = Math.cos(pose.heading_rad);
  return { x_m: pose.x_m - left * c - up * s, y_m: pose.y_m - left * s + up * c };
}

function middle({ from, to }: Dimension): Point {
  return { x_m: (from.x_m + to.x_m) / 2, y_m: (from.y_m + to.y_m) / 2 };
}

function outside(arc: readonly Point[], centre: Point | undefined): Point {
  const mid = arc[Math.floor(arc.length / 2)];
  if (!mid || !centre) return { x_m: 0, y_m: 0 };
  return { x_m: centre.x_m + (mid.x_m - centre.x_m) * 1.35, y_m: centre.y_m + (mid.y_m - centre.y_m) * 1.35 };
}

function useSize(ref: React.RefObject<HTMLDivElement | null>): { width: number; height: number } | undefined {
  const [size, setSize] = useState<{ width: number; height: number }>();
  useEffect(() => {
    const element = ref.current;
    if (!element) return;
    const observer = new ResizeObserver(([entry]) => {
      const box = entry?.contentRect;
      if (box && box.width > 0 && box.height > 0) setSize({ width: box.width, height: box.height });
    });
    observer.observe(element);
    return () => observer.disconnect();
  }, [ref]);
  return size;
}
