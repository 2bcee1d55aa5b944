export {
  MapView,
  type MapHandle,
  type MapLayers,
  type MapOverlays,
  type MapViewProps,
  type Picked,
} from "./MapView";
export { MapControls } from "./MapControls";
