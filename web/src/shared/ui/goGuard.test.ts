import { expect, it } from "vitest";
import { GoGuard } from "./goGuard";

/** Presses at these times, in ms: S on what stops, G on what sets in motion. Gives the G that counted. */
function counted(presses: readonly ["S" | "G", number][]): number[] {
  const guard = new GoGuard();
  return presses
    .filter(([what, at]) => {
      if (what === "S") guard.stopPressed(at);
      return what === "G" && guard.takes(at);
    })
    .map(([, at]) => at);
}

it.each<[string, ["S" | "G", number][], number[]]>([
  ["takes a press when nobody has stopped anything", [["G", 0]], [0]],
  [
    "refuses the taps that follow a pause",
    [
      ["S", 0],
      ["G", 350],
      ["G", 700],
      ["G", 1050],
    ],
    [],
  ],
  [
    "takes a decision made after the guard",
    [
      ["S", 0],
      ["G", 3000],
    ],
    [3000],
  ],
  [
    "counts the guard from the newest press on what stops",
    [
      ["S", 0],
      ["S", 2500],
      ["G", 3100],
    ],
    [],
  ],
  [
    "lets no finger through that has not rested",
    [
      ["S", 0],
      ["G", 2600],
      ["G", 2950],
      ["G", 3300],
      ["G", 3650],
    ],
    [],
  ],
  [
    "takes the calm press after a refused one",
    [
      ["S", 0],
      ["G", 2000],
      ["G", 3100],
    ],
    [3100],
  ],
])("%s", (_, presses, expected) => expect(counted(presses)).toEqual(expected));
