export * from "./hooks";
export { useNow } from "./clock";
export { liveStore, type LivePose, type LinkState } from "./store";
export { useMayCommand, useSession } from "./session";
export * from "./attention";
export * from "./pause";
