import { parseNumber } from "@/shared/words/parseNumber";
import type { Plant, Pose, StatedPose } from "@/shared/api/types";

/** What a person typed to say where the vehicle stands. */
export interface InitDraft {
  how: "station" | "numbers";
  station: string;
  x_mm: string;
  y_mm: string;
  heading_deg: string;
  /** With a tape, not by eye. Only who has measured it lets a vehicle drive that sees nothing that tells it better. */
  measured: boolean;
}

/** How far off a measured place may be. */
export const kMeasured = { within_m: 0.01, within_rad: (0.1 * Math.PI) / 180 };

export const emptyDraft: InitDraft = {
  how: "station",
  station: "",
  x_mm: "",
  y_mm: "",
  heading_deg: "",
  measured: false,
};

/** A pose as a person would have typed it, to a tenth of a millimetre. */
export function draftOf(pose: Pose): InitDraft {
  return {
    how: "numbers",
    station: "",
    x_mm: (pose.x_m * 1000).toFixed(1),
    y_mm: (pose.y_m * 1000).toFixed(1),
    heading_deg: ((pose.heading_rad * 180) / Math.PI).toFixed(3),
    measured: false,
  };
}

export type InitResult =
  | { kind: "pose"; pose: StatedPose }
  | { kind: "empty" }
  | { kind: "bad_station"; number: string }
  | { kind: "bad_number"; field: "x" | "y" | "heading" }
  | { kind: "bad_heading" };

export function readDraft(draft: InitDraft, plant: Plant | undefined): InitResult {
  if (draft.how === "station") {
    if (draft.station.trim() === "") return { kind: "empty" };
    const station = plant?.stations.find((s) => String(s.number) === draft.station.trim());
    return station ? { kind: "pose", pose: station.pose } : { kind: "bad_station", number: draft.station };
  }
  if (draft.x_mm === "" && draft.y_mm === "" && draft.heading_deg === "") return { kind: "empty" };
  const x = parseNumber(draft.x_mm);
  if (x === undefined) return { kind: "bad_number", field: "x" };
  const y = parseNumber(draft.y_mm);
  if (y === undefined) return { kind: "bad_number", field: "y" };
  const heading = parseNumber(draft.heading_deg);
  if (heading === undefined) return { kind: "bad_number", field: "heading" };
  if (Math.abs(heading) > 360) return { kind: "bad_heading" };
  const pose = { x_m: x / 1000, y_m: y / 1000, heading_rad: (heading * Math.PI) / 180 };
  return { kind: "pose", pose: draft.measured ? { ...pose, ...kMeasured } : pose };
}
