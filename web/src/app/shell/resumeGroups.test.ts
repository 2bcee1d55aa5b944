import { expect, it } from "vitest";
import type { Vehicle } from "@/shared/api/types";
import { resumeGroups, tickedAtFirst } from "./resumeGroups";

const vehicle = (id: string, over: Partial<Vehicle> = {}) =>
  ({
    id,
    name: id,
    link: "live",
    paused: false,
    needs_resume: false,
    operating_mode: "AUTOMATIC",
    ...over,
  }) as Vehicle;
const withFleet = { paused: true, pause: { by: "ann", with_fleet: true, stands: true } };
const singly = { paused: true, pause: { by: "bob", with_fleet: false, stands: true } };

it("keeps who was paused singly apart from the fleet's pause, and unticked", () => {
  const all = [
    vehicle("A", withFleet),
    vehicle("B", singly),
    vehicle("C"),
    vehicle("D", { needs_resume: true }),
    vehicle("E", { ...withFleet, link: "lost" }),
    vehicle("F", { ...singly, needs_resume: true }),
    vehicle("G", { needs_resume: true, operating_mode: "MANUAL" }), // nobody here lets it go
  ];
  expect(resumeGroups(all).map((g) => [g.group, g.vehicles.map((v) => v.id)])).toEqual([
    ["fleet", ["A", "E"]],
    ["waits", ["D"]],
    ["singly", ["B", "F"]],
  ]);
  expect(all.filter((v) => !["C", "G"].includes(v.id) && tickedAtFirst(v)).map((v) => v.id)).toEqual([
    "A",
    "D",
  ]);
});
