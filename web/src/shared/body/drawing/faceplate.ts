import type { Point, Vehicle, VehicleType } from "@/shared/api/types";

/** Sheet the platform is drawn on: body frame turned so that forward is right and left is up. */
export interface Sheet {
  halfLength: number;
  halfWidth: number;
  width: number; // of the view box, m
  height: number;
  scale: number; // of symbols, against Tang's platform
}

/** What is written on the sheet, and of which vehicle. */
export interface OnSheetProps {
  vehicle: Vehicle;
  type: VehicleType | undefined;
  sheet: Sheet;
}

const kAspect = 2.34;
const kPlatformWidth_m = 13.8; // sheet of the platform of 10.5 m, for which the symbols were drawn

/** Room for labels round the body, as shares of its size (from the mock). */
export function sheetOf(type: VehicleType | undefined): Sheet {
  const xs = (type?.footprint ?? []).map((p) => Math.abs(p.x_m));
  const ys = (type?.footprint ?? []).map((p) => Math.abs(p.y_m));
  const halfLength = xs.length ? Math.max(...xs) : 5.25;
  const halfWidth = ys.length ? Math.max(...ys) : 1.25;
  const width = 2 * Math.max(halfLength * 1.3143, halfWidth * 1.28 * kAspect);
  return { halfLength, halfWidth, width, height: width / kAspect, scale: width / kPlatformWidth_m };
}

/** A body point as shares of the sheet from its left top corner. */
export function onSheet(sheet: Sheet, p: Point): { left: string; top: string } {
  return {
    left: `${(50 + (100 * p.x_m) / sheet.width).toFixed(2)}%`,
    top: `${(50 - (100 * p.y_m) / sheet.height).toFixed(2)}%`,
  };
}

/** Parking feet carry no place in the model: a name tells its corner, else their order does. */
export function footCorner(name: string, index: number): { x: 1 | -1; y: 1 | -1 } {
  const lower = name.toLowerCase();
  const front = /front|^f/.test(lower);
  const back = /back|rear|^b|^r(?!ight)/.test(lower);
  const left = /left|l$/.test(lower);
  const right = /right|r$/.test(lower);
  const byOrder = [
    { x: 1, y: 1 },
    { x: 1, y: -1 },
    { x: -1, y: 1 },
    { x: -1, y: -1 },
  ] as const;
  const fallback = byOrder[index % 4] ?? byOrder[0];
  return {
    x: front ? 1 : back ? -1 : fallback.x,
    y: left ? 1 : right ? -1 : fallback.y,
  };
}

/** Where the vehicle type has the wheel of this name. */
export function wheelPlace(name: string, type: VehicleType | undefined) {
  return type?.wheels.find((w) => w.name === name);
}

/** Radius of the ring round a wheel's symbol, m. */
export function wheelRing_m(diameter_m: number, scale: number): number {
  return Math.max(0.27 * scale, wheelHalf_m(diameter_m, scale) + 0.06 * scale);
}
/** Half the length of the symbol: true to scale where that can be seen. */
export function wheelHalf_m(diameter_m: number, scale: number): number {
  return Math.max(0.15 * scale, diameter_m / 2);
}

export type WheelState = "ok" | "warm" | "fault";

export function wheelState(wheel: Vehicle["wheels"][number]): WheelState {
  if (wheel.fault !== "") return "fault";
  return wheel.warm ? "warm" : "ok";
}

/** Name of a bracket's corner for the texts: "front_left". */
export function bracketKey(type: VehicleType | undefined, name: string): string {
  const at = type?.brackets.find((b) => b.name === name)?.position;
  if (!at) return name;
  return `${at.x_m >= 0 ? "front" : "back"}_${at.y_m >= 0 ? "left" : "right"}`;
}
