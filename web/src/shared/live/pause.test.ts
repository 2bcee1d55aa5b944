import { expect, it } from "vitest";
import type { Fleet, Vehicle } from "@/shared/api/types";
import { fleetHalt, haltOf, pausedSingly } from "./pause";

const vehicle = (id: string, over: Partial<Vehicle> = {}) =>
  ({ id, name: id, link: "live", integration: "utilise", paused: false, ...over }) as Vehicle;
const paused = (stands: boolean, with_fleet = true) => ({
  paused: true,
  pause: { by: "ann", at: "2026-11-24T20:15:03Z", with_fleet, stands },
});
const fleet = (over: Partial<Fleet>) => ({ paused: false, ...over }) as Fleet;

it.each<[string, Partial<Vehicle>, string]>([
  ["not paused", {}, "none"],
  ["paused and braking", paused(false), "stopping"],
  ["late, and not yet seen to stand", { ...paused(false), link: "late" }, "stopping"],
  ["paused and at rest", paused(true), "stands"],
  ["silent after it was at rest", { ...paused(true), link: "lost" }, "stands"],
  ["paused and never heard of again", { ...paused(false), link: "gone" }, "unheard"],
])("%s", (_, over, halt) => expect(haltOf(vehicle("A", over))).toBe(halt));

it("is at rest only when every vehicle has said so", () => {
  const all = [
    vehicle("A", paused(true)),
    vehicle("B", paused(false)),
    vehicle("C", { ...paused(false), link: "lost" }),
    vehicle("D", { ...paused(false), link: "never" }),
    vehicle("E", { ...paused(false), integration: "ignore" }),
  ];
  expect(fleetHalt(fleet({ paused: true, pause: { by: "ann", at: "t" } }), all)).toEqual({
    by: "ann",
    at: "t",
    total: 3,
    held: 3,
    moving: 1,
    unheard: 1,
    all: true,
  });
});

it("goes on while some have been let go, and ends with the last", () => {
  const all = [vehicle("A", paused(true)), vehicle("B")];
  expect(fleetHalt(fleet({ pause: { by: "ann" } }), all)).toMatchObject({ held: 1, total: 2, all: false });
  expect(fleetHalt(fleet({}), all)).toBeUndefined();
  expect(fleetHalt(undefined, all)).toBeUndefined();
});

it("knows who was paused alone", () => {
  const all = [vehicle("A", paused(true)), vehicle("B", paused(true, false)), vehicle("C")];
  expect(pausedSingly(all).map((v) => v.id)).toEqual(["B"]);
});
