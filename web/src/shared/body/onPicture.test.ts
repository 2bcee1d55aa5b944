import { expect, it } from "vitest";
import { onPicture, outlineOf } from "./onPicture";

const type = {
  f_px: 1000,
  height_m: 0.5,
  cu_px: 640,
  cv_px: 512,
  k1: 0,
  body_from_camera: { x_m: 0, y_m: 0, heading_rad: 0 },
} as never;

it("has what is ahead to the right where the camera's x is the body's, and to the left of it above", () => {
  expect(onPicture(type, 0.1, 0)).toEqual({ u: 840, v: 512 });
  expect(onPicture(type, 0, 0.1)).toEqual({ u: 640, v: 312 });
});

it("has it above where the camera is turned by a quarter, and nearer in where it bends inwards", () => {
  const turned = { ...(type as object), body_from_camera: { heading_rad: -Math.PI / 2 } } as never;
  const { u, v } = onPicture(turned, 0.1, 0);
  expect([Math.round(u), Math.round(v)]).toEqual([640, 312]);
  const bent = { ...(type as object), k1: -0.1 } as never;
  expect(onPicture(bent, 0.1, 0).u).toBeCloseTo(640 + 200 * (1 - 0.1 * 0.04));
});

it("draws a code's outline with its own size and turn", () => {
  const camera = { forward_m: 0.01, left_m: 0, angle_rad: Math.PI / 4 } as never;
  const corners = outlineOf(type, camera, 0.06);
  const middle = onPicture(type, 0.01, 0);
  for (const { u, v } of corners)
    expect(Math.hypot(u - middle.u, v - middle.v)).toBeCloseTo(0.03 * Math.SQRT2 * 2000);
  expect(corners[0]!.v).toBeCloseTo(512 - 0.03 * Math.SQRT2 * 2000); // a corner straight to the left
});
