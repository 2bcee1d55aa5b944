import { expect, it } from "vitest";
import { press, type CommandProgress } from "./command";

const ready: CommandProgress = { kind: "ready" };

it.each<[string, CommandProgress, number | undefined, number | undefined, number, boolean, string]>([
  ["arms on the first press", ready, undefined, undefined, 0, true, "arm"],
  ["runs on the second", ready, 0, undefined, 1000, true, "run"],
  ["takes a double tap as one press", ready, 0, undefined, 200, true, "none"],
  ["arms again after 8 s", ready, 0, undefined, 8000, true, "arm"],
  ["runs at once where one step is enough", ready, undefined, undefined, 0, false, "run"],
  ["runs a one-step double tap once", ready, undefined, 0, 200, false, "none"],
  ["does nothing while requested", { kind: "requested", atMs: 0 }, 0, undefined, 1000, true, "none"],
  [
    "does nothing while accepted",
    { kind: "accepted", waitingFor: "TP-01" },
    0,
    undefined,
    1000,
    true,
    "none",
  ],
  [
    "does nothing once confirmed",
    { kind: "confirmed", by: "TP-01", afterS: 1 },
    0,
    undefined,
    1000,
    true,
    "none",
  ],
  [
    "can be armed again after a time-out",
    { kind: "timed_out", what: "", next: "" },
    undefined,
    0,
    9000,
    true,
    "arm",
  ],
])("%s", (_, progress, armedAt, lastRun, now, twoStep, kind) => {
  expect(press(progress, armedAt, lastRun, now, twoStep).kind).toBe(kind);
});
