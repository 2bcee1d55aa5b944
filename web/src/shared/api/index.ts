export { api, call, callTagged, kRequestTimeoutMs } from "./client";
export { openHandHeld } from "./handHeldSocket";
export { ApiProblem } from "./problem";
export type * from "./types";
