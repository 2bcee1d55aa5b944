import type { VehicleType } from "@/shared/api/types";

export type Direction = "ahead" | "back" | "left" | "right" | "turn_left" | "turn_right";

export interface Twist {
  vx_mps: number;
  vy_mps: number;
  turn_radps: number;
}

/** As fast as a person walks beside it; the vehicle's own limit (core/onboard/hand_drive). */
export const kWalk_mps = 0.3;
export const kTurn_radps = 0.1;
/** Shares of that: to set it down by the millimetre, to align it, to walk beside it. */
export const kShares = [1 / 15, 1 / 3, 1] as const;

export const kStill: Twist = { vx_mps: 0, vy_mps: 0, turn_radps: 0 };

/** What the pressed directions ask for together; opposite ones ask for nothing. Body frame. */
export function twistOf(pressed: ReadonlySet<Direction>, share: number): Twist {
  const axis = (plus: Direction, minus: Direction) => Number(pressed.has(plus)) - Number(pressed.has(minus));
  const ahead = axis("ahead", "back");
  const left = axis("left", "right");
  const speed = (share * kWalk_mps) / Math.max(1, Math.hypot(ahead, left));
  return {
    vx_mps: ahead * speed,
    vy_mps: left * speed,
    turn_radps: axis("turn_left", "turn_right") * share * kTurn_radps,
  };
}

export const isStill = (twist: Twist) => twist.vx_mps === 0 && twist.vy_mps === 0 && twist.turn_radps === 0;

/** Wheels that are fixed are not dragged sideways. */
export const goesSideways = (type: VehicleType | undefined) => type?.kinematics !== "differential";

/** Keys by their place on the keyboard, so that every layout has the same cross. */
export const kKeys: Readonly<Record<string, Direction>> = {
  ArrowUp: "ahead",
  KeyW: "ahead",
  ArrowDown: "back",
  KeyS: "back",
  ArrowLeft: "left",
  KeyA: "left",
  ArrowRight: "right",
  KeyD: "right",
  KeyQ: "turn_left",
  KeyE: "turn_right",
};
export const kHoldKey = "Space";
