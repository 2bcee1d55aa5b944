export { api, call } from "./client";
export { openHandHeld } from "./handHeldSocket";
export { ApiProblem } from "./problem";
export type * from "./types";
