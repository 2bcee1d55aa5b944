import { expect, it } from "vitest";
import type { Vehicle } from "@/shared/api/types";
import { sinceOf, sinceSeen } from "./since";

const vehicle = (over: Partial<Vehicle>) =>
  ({
    id: "A",
    link: "live",
    activity: "waiting",
    pose_known: true,
    integration: "utilise",
    errors: [],
    brackets: [],
    wheels: [],
    ...over,
  }) as Vehicle;
const held = (by: string) => ({ code: "floor_held", params: { by } });
const at = (s: number) => new Date(s * 1000).toISOString();

it.each<[string, Partial<Vehicle>, boolean, number, boolean]>([
  ["goes on waiting for somebody else", { reason: held("C") }, true, 1000, false],
  ["moves off", { activity: "moving" }, true, 5000, true],
  ["was found moving after a gap", { activity: "moving" }, false, 5000, false],
  ["is at fault", { e_stop: "MANUAL" }, true, 5000, true],
])("seen: %s", (_, over, seen, atMs, exact) => {
  const known = sinceSeen(undefined, vehicle({ reason: held("B") }), 1000, false);

  expect(sinceSeen(known, vehicle(over), 5000, seen)).toMatchObject({ atMs, exact });
});

const known = { doing: "waiting", atMs: 9000, exact: false };
it.each<[string, Partial<Vehicle>, object | undefined]>([
  ["waiting is nowhere told", {}, known],
  [
    "a pause is",
    { paused: true, pause: { at: at(4), with_fleet: false, stands: true } },
    { atMs: 4000, exact: true },
  ],
  ["a silence is", { link: "lost", last_heard_at: at(3) }, { atMs: 3000, exact: true }],
  [
    "a drive is",
    { activity: "moving", leg: { started_at: at(2) } as Vehicle["leg"] },
    { atMs: 2000, exact: true },
  ],
  ["a drive without a time is not", { activity: "moving" }, known],
])("told: %s", (_, over, expected) => expect(sinceOf(vehicle(over), known)).toEqual(expected));
