import type { Plant, Pose } from "@/shared/api/types";
import type { Picked } from "@/shared/map";

/** Where a person says that a vehicle stands, and what the next press on the map means. */
export interface PlaceDraft {
  pose: Pose | undefined;
  /** Number of the station, while the pose is just its own. */
  station: number | undefined;
  next: "place" | "front";
  /** Index into kSteps. */
  step: number;
}

export const kSteps = [
  { m: 1, deg: 10 },
  { m: 0.1, deg: 1 },
  { m: 0.01, deg: 0.1 },
] as const;

export const emptyPlace: PlaceDraft = { pose: undefined, station: undefined, next: "place", step: 1 };

const kTurn = 2 * Math.PI;
const wrapped = (angle: number) => angle - kTurn * Math.round(angle / kTurn);
/** Free of the dust that adding steps leaves: 0.1 mm, 0.001 deg. */
const tidy = (pose: Pose): Pose => {
  const deg = Math.round(((wrapped(pose.heading_rad) * 180) / Math.PI) * 1000) / 1000;
  return {
    x_m: Math.round(pose.x_m * 10_000) / 10_000,
    y_m: Math.round(pose.y_m * 10_000) / 10_000,
    heading_rad: (deg * Math.PI) / 180,
  };
};

/** A press: a station is a whole pose; bare floor is a place, then where the front points. */
export function placePressed(
  draft: PlaceDraft,
  picked: Picked,
  plant: Plant,
  heading_rad: number,
): PlaceDraft {
  if (picked.kind === "vehicle") return draft;
  if (picked.kind === "station") {
    const station = plant.stations.find((s) => s.id === picked.id);
    if (station === undefined) return draft;
    return { ...draft, pose: station.pose, station: station.number, next: "place" };
  }
  const { x_m, y_m } = picked.point;
  const { pose } = draft;
  if (draft.next === "front" && pose !== undefined) {
    const far = Math.hypot(x_m - pose.x_m, y_m - pose.y_m);
    if (far < 1e-6) return draft;
    const turned = Math.atan2(y_m - pose.y_m, x_m - pose.x_m);
    // By hand nobody points better than a degree.
    const whole = (Math.round((turned * 180) / Math.PI) * Math.PI) / 180;
    return { ...draft, pose: tidy({ ...pose, heading_rad: whole }), station: undefined, next: "place" };
  }
  const at = tidy({ x_m, y_m, heading_rad: pose?.heading_rad ?? heading_rad });
  return { ...draft, pose: at, station: undefined, next: "front" };
}

export type Axis = "east" | "north" | "heading";

/** One fine step; `start` is where it goes on from while nothing was chosen. */
export function nudged(draft: PlaceDraft, axis: Axis, sign: 1 | -1, start: Pose | undefined): PlaceDraft {
  const pose = draft.pose ?? start;
  if (pose === undefined) return draft;
  const { m, deg } = kSteps[draft.step] ?? kSteps[1];
  const moved = {
    x_m: pose.x_m + (axis === "east" ? sign * m : 0),
    y_m: pose.y_m + (axis === "north" ? sign * m : 0),
    heading_rad: pose.heading_rad + (axis === "heading" ? (sign * deg * Math.PI) / 180 : 0),
  };
  return { ...draft, pose: tidy(moved), station: undefined };
}

const kSame_m = 0.05;
const kSame_rad = (1 * Math.PI) / 180;

/** Whether the vehicle now says that it stands where the person said. */
export function standsAt(pose: Pose | undefined, said: Pose): boolean {
  if (pose === undefined) return false;
  const turn = Math.abs(wrapped(pose.heading_rad - said.heading_rad));
  return Math.hypot(pose.x_m - said.x_m, pose.y_m - said.y_m) <= kSame_m && turn <= kSame_rad;
}
