import { expect, it } from "vitest";
import { age, days, degrees, duration, fixed, kNone, mass, millimetres, number, parameter } from "./format";

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
])("number(%s) with its sign is %s", (value, text) =>
  expect(number(value, { decimals: 1, sign: true })).toBe(text),
);

it("shows millimetres and degrees of metres and radians", () => {
  expect(millimetres(0.025)).toBe("25");
  expect(millimetres(-0.0042, { decimals: 1, sign: true })).toBe("\u22124.2");
  expect(degrees(Math.PI / 2, { decimals: 1 })).toBe("90.0");
  expect(degrees((0.2 * Math.PI) / 180, { decimals: 2, sign: true })).toBe("+0.20");
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

// Of reasons, refusals and checks alike: they are worded by one engine.
it.each([
  ["along_m", -6.8, "6.80\u00a0m"],
  ["clearance_m", 0.31, "0.31\u00a0m"],
  ["length_m", 12.5, "12.50\u00a0m"],
  ["area_m2", 264.2, "264\u00a0m²"],
  ["speed_mps", 0.5, "0.50\u00a0m/s"],
  ["heading_rad", Math.PI, "180.00°"],
  ["silent_s", 12.4, "12\u00a0s"],
  ["total_n", 215_700, "215.7\u00a0kN"],
  ["load_kg", 21500, "21.5\u00a0t"],
  ["temperature_c", 71.2, "71\u00a0°C"],
  ["unbalance_percent", 3.1, "3.1\u00a0%"],
  ["limit_percent", 5, "5\u00a0%"],
  ["station", 1200, "1200"],
  ["ratio", 0.256, "0.26"],
])("parameter(%s, %s) is %s", (name, value, text) => expect(parameter(name, value)).toBe(text));
