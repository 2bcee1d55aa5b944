import {
  useEffect,
  useImperativeHandle,
  useLayoutEffect,
  useMemo,
  useRef,
  useState,
  type KeyboardEvent,
  type Ref,
} from "react";
import { useTranslation } from "react-i18next";
import type { Plant } from "@/shared/api/types";
import { useTheme } from "@/shared/i18n/useTheme";
import { liveStore } from "@/shared/live/store";
import { boxOf, type Box, type MetricPoint } from "@/shared/math/geometry";
import "./map.css";
import { readPalette, type Palette } from "./palette";
import { Picker, type Picked } from "./pick";
import { CanvasRenderer } from "./renderer";
import { allLayers, hallModel, type MapLayers, type MapOverlays } from "./scene";
import { useGestures, type Gestures } from "./useGestures";
import {
  fitted,
  kept,
  panned,
  toHall,
  zoomAt,
  type Margins,
  type ScreenPoint,
  type Size,
  type View,
} from "./view";

export type { Picked } from "./pick";
export type { MapLayers, MapOverlays } from "./scene";

export interface MapHandle {
  zoomIn(): void;
  zoomOut(): void;
  /** The whole hall. */
  fit(): void;
  /** These points, with some room around them. */
  show(points: readonly MetricPoint[], roomM?: number): void;
}

export interface MapViewProps {
  plant: Plant;
  /** Hall to show; the plant's first by default. */
  hall?: string;
  layers?: Partial<MapLayers>;
  overlays?: MapOverlays;
  /** What is shown while the person has not moved the map; the whole hall by default. */
  about?: readonly MetricPoint[];
  /** Vehicle drawn in blue, with its route. */
  selected?: string | undefined;
  /** Keeps this vehicle in the middle until the person moves the map. */
  follow?: string | undefined;
  onFollowEnd?: () => void;
  onPick?: (picked: Picked) => void;
  /** What a press means where a vehicle stands on a station; "point" takes the bare floor. */
  prefer?: "vehicle" | "station" | "point";
  label?: string;
  ref?: Ref<MapHandle>;
}

const kNoOverlays: MapOverlays = {};
const kKeyPanPx = 60;
const kKeyZoom = 1.25;
const kMargins: Margins = { left: 52, top: 36, right: 24, bottom: 34 };
/** On a phone the room is the hall's: no rulers. */
const kPhonePx = 560;
const kPhoneMargins: Margins = { left: 10, top: 10, right: 10, bottom: 10 };
const marginsOf = (size: Size): Margins => (size.width < kPhonePx ? kPhoneMargins : kMargins);
const kAgeTickMs = 250;

const kRoom = 0.12;
const kLeastM = 12;

/** The view that nobody has changed: the whole hall, or what the page is about with some room round it. */
function home(hall: Box, about: readonly MetricPoint[] | undefined, size: Size): View {
  if (about === undefined || about.length === 0) return fitted(hall, size, marginsOf(size));
  const b = boxOf(about);
  const x = Math.max(kRoom * (b.maxX - b.minX), (kLeastM - (b.maxX - b.minX)) / 2);
  const y = Math.max(kRoom * (b.maxY - b.minY), (kLeastM - (b.maxY - b.minY)) / 2);
  return fitted(
    { minX: b.minX - x, maxX: b.maxX + x, minY: b.minY - y, maxY: b.maxY + y },
    size,
    marginsOf(size),
  );
}

/** Map of one hall, drawn to scale. Poses go from the store to the canvas without React. */
export function MapView(props: MapViewProps) {
  const {
    plant,
    hall,
    layers,
    overlays = kNoOverlays,
    selected,
    follow,
    about,
    prefer = "vehicle",
    onPick,
    onFollowEnd,
  } = props;
  const { t, i18n } = useTranslation("mapview");
  const theme = useTheme();
  const box = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const model = useMemo(() => hallModel(plant, hall), [plant, hall]);
  const picker = useMemo(() => model && new Picker(model), [model]);
  const [size, setSize] = useState<Size>();
  const view = useRef<View>(undefined);
  const isFitted = useRef(true);
  const renderer = useRef<CanvasRenderer>(undefined);
  const palette = useRef<Palette>(undefined);
  const frame = useRef(0);

  const phone = size !== undefined && size.width < kPhonePx;
  const allOn = useMemo(
    () => ({ ...allLayers, ...layers, ...(phone && { rulers: false }) }),
    [layers, phone],
  );
  const now = useRef({ model, size, overlays, selected, follow, about, layers: allOn, t });
  now.current = { model, size, overlays, selected, follow, about, layers: allOn, t };

  const draw = useRef(() => {});
  draw.current = () => {
    frame.current = 0;
    const { model: m, size: s, follow: f } = now.current;
    if (canvas.current === null || m === undefined || s === undefined) return;
    renderer.current ??= new CanvasRenderer(canvas.current);
    palette.current ??= readPalette(canvas.current);
    if (view.current === undefined || isFitted.current) view.current = home(m.box, now.current.about, s);
    const followed =
      f === undefined ? undefined : (liveStore.poses.get(f) ?? liveStore.state.vehicles.get(f)?.pose);
    if (followed !== undefined) {
      isFitted.current = false;
      view.current = { ...view.current, cx: followed.x_m, cy: followed.y_m };
    }
    const { state, poses } = liveStore;
    renderer.current.draw({
      view: view.current,
      size: s,
      dpr: window.devicePixelRatio || 1,
      palette: palette.current,
      model: m,
      layers: now.current.layers,
      overlays: now.current.overlays,
      selected: now.current.selected,
      live: {
        vehicles: state.vehicles,
        stations: state.stations,
        poses,
        closures: state.closures,
        linkLost: state.link.kind === "lost",
      },
      words: {
        old: (age) => now.current.t("old", { age }),
        north: now.current.t("north"),
        activity: () => now.current.t("blocked"),
      },
      nowMs: performance.now(),
    });
  };
  const request = useRef(() => {
    if (frame.current === 0) frame.current = requestAnimationFrame(() => draw.current());
  });

  useEffect(() => {
    const ask = request.current;
    const stop = [liveStore.subscribe(ask), liveStore.subscribePoses(ask)];
    // Ages and labels go on while nothing moves.
    const timer = setInterval(ask, kAgeTickMs);
    return () => {
      clearInterval(timer);
      stop.forEach((end) => end());
      cancelAnimationFrame(frame.current);
      frame.current = 0;
    };
  }, []);

  useLayoutEffect(() => {
    const element = box.current;
    if (element === null) return;
    const observer = new ResizeObserver(() => {
      const { clientWidth: width, clientHeight: height } = element;
      if (width > 0 && height > 0) setSize({ width, height });
    });
    observer.observe(element);
    return () => observer.disconnect();
  }, []);

  useEffect(() => {
    palette.current = undefined;
    request.current();
  }, [theme]);
  useEffect(() => request.current());
  const place = about && JSON.stringify(boxOf(about));
  useEffect(() => {
    isFitted.current = true;
    request.current();
  }, [model, place]);

  const change = (next: (v: View, s: Size) => View, ends = true) => {
    const { size: s, model: m } = now.current;
    if (view.current === undefined || s === undefined || m === undefined) return;
    isFitted.current = false;
    view.current = kept(next(view.current, s), m.box);
    if (ends && now.current.follow !== undefined) onFollowEnd?.();
    request.current();
  };
  const middle = (s: Size): ScreenPoint => ({ x: s.width / 2, y: s.height / 2 });
  const zoomBy = (factor: number) => change((v, s) => zoomAt(v, s, middle(s), factor), false);
  const fit = () => {
    isFitted.current = true;
    if (now.current.follow !== undefined) onFollowEnd?.();
    request.current();
  };

  const gestures = useRef<Gestures>(undefined as unknown as Gestures);
  gestures.current = {
    pan: (dx, dy) => change((v) => panned(v, dx, dy)),
    zoom: (at, factor) => change((v, s) => zoomAt(v, s, at, factor), false),
    press: (at) => {
      const { size: s } = now.current;
      if (onPick === undefined || picker === undefined || view.current === undefined || s === undefined)
        return;
      onPick(
        picker.pick(toHall(view.current, s, at), view.current.pxPerM, renderer.current?.drawn ?? [], prefer),
      );
    },
    hover: () => {},
  };
  useGestures(canvas, gestures);

  useImperativeHandle(props.ref, () => ({
    zoomIn: () => zoomBy(kKeyZoom * 1.2),
    zoomOut: () => zoomBy(1 / (kKeyZoom * 1.2)),
    fit,
    show: (points, roomM = 3) => {
      const b = boxOf(points);
      const wide = { minX: b.minX - roomM, minY: b.minY - roomM, maxX: b.maxX + roomM, maxY: b.maxY + roomM };
      change((_, s) => fitted(wide, s, marginsOf(s)));
    },
  }));

  const onKey = (event: KeyboardEvent) => {
    const actions: Record<string, () => void> = {
      ArrowLeft: () => change((v) => panned(v, kKeyPanPx, 0)),
      ArrowRight: () => change((v) => panned(v, -kKeyPanPx, 0)),
      ArrowUp: () => change((v) => panned(v, 0, kKeyPanPx)),
      ArrowDown: () => change((v) => panned(v, 0, -kKeyPanPx)),
      "+": () => zoomBy(kKeyZoom),
      "=": () => zoomBy(kKeyZoom),
      "-": () => zoomBy(1 / kKeyZoom),
      "0": fit,
    };
    const action = actions[event.key];
    if (action === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
  };

  return (
    <div className="mapbox" ref={box}>
      <canvas
        ref={canvas}
        className={`canvas ${prefer !== "vehicle" && onPick ? "picks" : ""}`}
        tabIndex={0}
        role="application"
        lang={i18n.language === "zh" ? "zh-CN" : "en"}
        aria-label={props.label ?? t("label")}
        onKeyDown={onKey}
      />
    </div>
  );
}
