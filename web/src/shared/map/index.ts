export {
  MapView,
  type MapHandle,
  type MapLayers,
  type MapOverlays,
  type MapViewProps,
  type Picked,
} from "./MapView";
export { MapControls } from "./MapControls";
export { closurePlace } from "./drawClosures";
export type { Dimension, SweptArea } from "./scene";
export { hallModel, type HallModel, type Lane } from "./scene";
