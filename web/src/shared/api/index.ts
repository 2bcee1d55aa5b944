export { api, call } from "./client";
export { ApiProblem } from "./problem";
export type * from "./types";
