import { expect, it } from "vitest";
import { age, days, deg, duration, fixed, kNone, mass, mm, signed, signedDeg, signedMm } from "./format";

it.each([
  [-1.25, 1, "\u22121.3"],
  [-0.04, 1, "0.0"],
  [2, 0, "2"],
  [Number.NaN, 1, kNone],
  [undefined, 1, kNone],
])("fixed(%s, %s) is %s", (value, decimals, text) => expect(fixed(value, decimals)).toBe(text));

it.each([
  [3.14, "+3.1"],
  [-3.14, "\u22123.1"],
  [0.01, "0.0"],
])("signed(%s) shows its sign: %s", (value, text) => expect(signed(value, 1)).toBe(text));

it("shows millimetres and degrees of metres and radians", () => {
  expect(mm(0.025)).toBe("25\u00a0mm");
  expect(signedMm(-0.0042)).toBe("\u22124.2");
  expect(deg(Math.PI / 2)).toBe("90.0°");
  expect(signedDeg((0.2 * Math.PI) / 180)).toBe("+0.20");
});

it.each([
  [0, "0:00"],
  [83.6, "1:24"],
  [3661, "1:01:01"],
  [-4, "0:00"],
])("duration(%s) is %s", (s, text) => expect(duration(s)).toBe(text));

it.each([
  [172_799, "47:59:59"],
  [172_800, "2\u00a0d"],
  [31_536_000, "365\u00a0d"],
  [undefined, kNone],
])("days(%s) is %s", (s, text) => expect(days(s)).toBe(text));

it.each([
  [0.24, "0.2\u00a0s"],
  [9.97, "10\u00a0s"],
  [59.7, "1:00"],
  [-1, "0.0\u00a0s"],
])("age(%s) is %s", (s, text) => expect(age(s)).toBe(text));

it("shows heavy loads in tonnes", () => {
  expect(mass(22000)).toBe("22.0\u00a0t");
  expect(mass(85)).toBe("85\u00a0kg");
});
