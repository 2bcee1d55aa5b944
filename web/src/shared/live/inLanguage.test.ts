import { expect, test } from "vitest";
import type { Plant } from "../api/types";
import { inLanguage, namedIn } from "./inLanguage";

const thing = (name: string, zh?: string) => ({ name, ...(zh === undefined ? {} : { names: { zh } }) });
const plant = {
  ...thing("Final assembly", "总装"),
  halls: [thing("Hall 3", "三号厂房")],
  stations: [thing("Wings", "机翼"), thing("Station without")],
  areas: [thing("B Measuring hall", "B 测量厂房")],
  vehicle_types: [thing("Transport platform", "运输平台")],
  vehicles: [{ name: "TP-01" }],
} as unknown as Plant;

test("everything that has a name in the language is called by it, the rest as the plant says", () => {
  const zh = inLanguage(plant, "zh");
  expect(
    [zh, ...zh.halls, ...zh.stations, ...zh.areas, ...zh.vehicle_types, ...zh.vehicles].map((x) => x.name),
  ).toEqual(["总装", "三号厂房", "机翼", "Station without", "B 测量厂房", "运输平台", "TP-01"]);
});

test("a language that the plant does not speak leaves its own names", () => {
  expect(inLanguage(plant, "en")).toEqual(plant);
});

test("a load is called by its name in the language, and by its own without one", () => {
  expect(namedIn(thing("A-105", "教练机"), "zh").name).toBe("教练机");
  expect(namedIn(thing("A-105", "教练机"), "en").name).toBe("A-105");
});
