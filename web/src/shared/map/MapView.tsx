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
import type { Plant, Vehicle } from "@/shared/api/types";
import { liveStore } from "@/shared/live/store";
import { boxOf, type MetricPoint } from "@/shared/math/geometry";
import { homeView, isPhone, marginsOf, withInSight } from "./home";
import { closureName } from "@/shared/words/closures";
import { inHandText } from "@/shared/words/inHand";
import "./map.css";
import { Picker, type Picked } from "./pick";
import { allLayers, hallModel, type MapLayers, type MapOverlays } from "./scene";
import { useDrawing } from "./useDrawing";
import { useGestures, type Gestures } from "./useGestures";
import {
  fitted,
  kept,
  panned,
  toHall,
  toScreen,
  zoomAt,
  type ScreenPoint,
  type Size,
  type View,
} from "./view";

export type { Picked } from "./pick";
export type { MapLayers, MapOverlays } from "./scene";

export interface MapHandle {
  /** About the selected vehicle, where there is one, else about the middle. */
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

const poseOf = (id: string | undefined) =>
  id === undefined ? undefined : (liveStore.poses.get(id) ?? liveStore.state.vehicles.get(id)?.pose);

/** Map of one hall, drawn to scale. */
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
  const box = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const model = useMemo(() => hallModel(plant, hall), [plant, hall]);
  const picker = useMemo(() => model && new Picker(model), [model]);
  const [size, setSize] = useState<Size>();
  const view = useRef<View>(undefined);
  const isFitted = useRef(true);

  const phone = size !== undefined && isPhone(size);
  const allOn = useMemo(
    () => ({ ...allLayers, ...layers, ...(phone && { rulers: false }) }),
    [layers, phone],
  );
  const words = useMemo(
    () => ({
      old: (age: string) => t("old", { age }),
      north: t("north"),
      closure: (name: string) => closureName(name, t),
      alarm: (kind: string) => t(`tag.${kind}`),
      inHand: (vehicle: Pick<Vehicle, "in_hand_of">) =>
        inHandText(vehicle, (key, values) => t(key, values ?? {})),
    }),
    [t],
  );

  const drawing = useDrawing(canvas, () => {
    if (model === undefined || size === undefined) return undefined;
    if (view.current === undefined || isFitted.current) view.current = homeView(model.box, about, size);
    const followed = poseOf(follow);
    if (followed !== undefined) {
      isFitted.current = false;
      view.current = { ...view.current, cx: followed.x_m, cy: followed.y_m };
    }
    return { view: view.current, size, model, layers: allOn, overlays, selected, words };
  });
  const { request } = drawing;

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
  const place = about && JSON.stringify(boxOf(about));
  useEffect(() => {
    isFitted.current = true;
    request();
  }, [model, place, request]);
  // Choosing a vehicle may give the drawing less room: the chosen one stays in sight.
  useEffect(() => {
    const pose = poseOf(selected);
    if (pose === undefined || size === undefined || view.current === undefined || isFitted.current) return;
    view.current = withInSight(view.current, size, pose);
    request();
  }, [selected, size, request]);

  const change = (next: (v: View, s: Size) => View, ends = true) => {
    if (view.current === undefined || size === undefined || model === undefined) return;
    isFitted.current = false;
    view.current = kept(next(view.current, size), model.box);
    if (ends && follow !== undefined) onFollowEnd?.();
    request();
  };
  const zoomBy = (factor: number) =>
    change((v, s) => {
      const pose = poseOf(selected);
      if (pose === undefined) return zoomAt(v, s, { x: s.width / 2, y: s.height / 2 }, factor);
      const seen = withInSight(v, s, pose);
      return zoomAt(seen, s, toScreen(seen, s, pose), factor);
    }, false);
  const fit = () => {
    isFitted.current = true;
    if (follow !== undefined) onFollowEnd?.();
    request();
  };

  const gestures = useRef<Gestures>(undefined as unknown as Gestures);
  gestures.current = {
    pan: (dx, dy) => change((v) => panned(v, dx, dy)),
    zoom: (at, factor) => change((v, s) => zoomAt(v, s, at, factor), false),
    press: (at: ScreenPoint) => {
      if (onPick === undefined || picker === undefined || view.current === undefined || size === undefined)
        return;
      onPick(picker.pick(toHall(view.current, size, at), view.current.pxPerM, drawing.drawn(), prefer));
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
