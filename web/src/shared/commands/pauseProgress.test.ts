import { expect, it } from "vitest";
import type { Vehicle } from "@/shared/api/types";
import type { CommandProgress } from "@/shared/ui/command";
import { pauseProgress } from "./pauseProgress";

const kAt = Date.parse("2026-11-24T20:15:03Z");
const asked: CommandProgress = { kind: "accepted", waitingFor: "TP-01" };
const vehicle = (over: Partial<Vehicle>) =>
  ({ id: "TP-01", name: "TP-01", link: "live", paused: false, activity: "moving", ...over }) as Vehicle;
const paused = (stands: boolean) => ({
  paused: true,
  pause: { at: "2026-11-24T20:15:03Z", with_fleet: false, stands },
});
const key = (key: string) => key;

it.each<[string, Partial<Vehicle>, number, CommandProgress]>([
  ["what was asked, while the server does not hold it", {}, 0, asked],
  ["moving", paused(false), 3000, { kind: "under_way", title: "stopping", small: "still_moves" }],
  [
    "at rest and not yet said",
    { ...paused(false), activity: "paused" },
    500,
    { kind: "under_way", title: "stopping", small: "not_said" },
  ],
  ["at rest, said", paused(true), 3000, { kind: "holds", title: "paused", small: "stands" }],
  ["not at rest in time", paused(false), 15_000, { kind: "timed_out", what: "moves_on", next: "stop_there" }],
  [
    "silent",
    { ...paused(false), link: "lost" },
    3000,
    { kind: "timed_out", what: "unheard", next: "go_there" },
  ],
])("%s", (_, over, afterMs, expected) => {
  expect(pauseProgress(vehicle(over), asked, kAt + afterMs, key)).toEqual(expected);
});
