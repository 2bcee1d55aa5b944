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
export { hallModel, type HallModel, type Lane } from "./scene";
