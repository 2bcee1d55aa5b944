import { describe, expect, it } from "vitest";
import type { Check, Station, DryRun, ModeOption, Vehicle } from "@/shared/api/types";
import {
  chosenOption,
  foldChecks,
  NewestOnly,
  previewKey,
  readiness,
  sortChecks,
  sortOptions,
  type Preview,
} from "./preview";
import type { StationEntry } from "../steps/stationEntry";
import { shownPreview } from "./usePreview";

const check = (code: Check["code"], result: Check["result"]): Check => ({ code, result, params: {} });
const option = (mode: ModeOption["mode"], feasible: boolean, suggested = false): ModeOption => ({
  mode,
  feasible,
  suggested,
});
const options = [option("self_rotation", false), option("free", true), option("linear", true, true)];
const data = (over: Partial<DryRun> = {}): DryRun => ({
  vehicle: "TP-01",
  accepted: true,
  checks: [check("link", "pass")],
  steps: [
    { station: "st07", number: 7, start: { x_m: 0, y_m: 0, heading_rad: 0 }, options, alternatives: [] },
  ],
  ...over,
});
const vehicle = { id: "TP-01" } as Vehicle;
const question = { key: "a", vehicle: "TP-01", station: 7, mode: "auto" as const, actions: {} };

describe("previewKey", () => {
  const input = {
    vehicle: "v",
    station: 1,
    mode: "auto" as const,
    pose: { x_m: 1, y_m: 2, heading_rad: 0 },
    link: "live",
    stationsKey: "",
    after: "",
  };
  it("keeps through the noise of a standing vehicle", () => {
    const noise = { ...input, pose: { x_m: 1.0004, y_m: 1.9996, heading_rad: 0.0001 } };

    expect(previewKey(noise)).toBe(previewKey(input));
  });
  it.each([
    ["pose", { pose: { x_m: 1.03, y_m: 2, heading_rad: 0 } }],
    ["station", { station: 2 }],
    ["mode", { mode: "linear" as const }],
    ["link", { link: "lost" }],
    ["occupation", { stationsKey: "TP-02/" }],
    ["lost pose", { pose: undefined }],
    ["orders before it", { after: "o7" }],
  ])("changes with the %s", (_, change) =>
    expect(previewKey({ ...input, ...change })).not.toBe(previewKey(input)),
  );
  it("does not hang on where the vehicle is while it ends other orders first", () => {
    const behind = { ...input, after: "o7" };

    expect(previewKey({ ...behind, pose: { x_m: 9, y_m: 9, heading_rad: 1 } })).toBe(previewKey(behind));
  });
});

describe("NewestOnly", () => {
  it("lets only the answer to the newest question through", () => {
    const newest = new NewestOnly();
    const first = newest.next();
    const second = newest.next();

    expect([first.isNewest(), second.isNewest()]).toEqual([false, true]);
    newest.drop();
    expect(second.isNewest()).toBe(false);
  });
});

describe("shownPreview", () => {
  const ready: Preview = { kind: "ready", data: data() };
  it("shows an answer to another station as loading without data", () => {
    expect(shownPreview({ ...question, station: 6 }, ready, "a")).toEqual({
      kind: "loading",
      last: undefined,
    });
  });
  it("keeps the last answer about the same move while it is asked again", () => {
    expect(shownPreview({ ...question, key: "b" }, ready, "a")).toEqual({ kind: "loading", last: data() });
  });
  it("is ready only for the question that was answered", () =>
    expect(shownPreview(question, ready, "a")).toEqual(ready));
});

describe("checks", () => {
  const all = [check("link", "pass"), check("wheels", "note"), check("safety", "fail")];
  it("puts fails on top and leaves the rest in the server's order", () => {
    expect(sortChecks(all).map((c) => c.code)).toEqual(["safety", "link", "wheels"]);
  });
  it("folds only what passed, and only where there is little room", () => {
    expect(foldChecks(all, false)).toEqual({ rows: sortChecks(all), folded: [] });
    const { rows, folded } = foldChecks(all, true);
    expect([rows.map((c) => c.code), folded.map((c) => c.code)]).toEqual([["safety", "wheels"], ["link"]]);
  });
  it("puts what makes it wait before what passes, and hides it nowhere", () => {
    const taken = [check("link", "pass"), check("station", "note"), check("wheels", "note")];
    expect(sortChecks(taken).map((c) => c.code)).toEqual(["station", "link", "wheels"]);
    expect(foldChecks(taken, true).rows.map((c) => c.code)).toEqual(["station", "wheels"]);
  });
});

describe("modes", () => {
  it("lists the suggested one first and the infeasible ones last", () => {
    expect(sortOptions(options).map((o) => o.mode)).toEqual(["linear", "free", "self_rotation"]);
  });
  it("takes the suggested one for auto, else the person's", () => {
    expect(chosenOption(data().steps[0], "auto")?.mode).toBe("linear");
    expect(chosenOption(data().steps[0], "free")?.mode).toBe("free");
  });
});

describe("readiness", () => {
  const ok = {
    vehicle,
    entry: { kind: "free", station: { number: 7 } as Station } as StationEntry,
    mode: "auto" as const,
    linkUp: true,
    mayCommand: true,
    busy: false,
    preview: { kind: "ready", data: data() } as Preview,
  };
  it.each<[string, Partial<typeof ok>, string]>([
    ["ready", {}, "ready"],
    ["without a link", { linkUp: false }, "offline"],
    ["as a viewer", { mayCommand: false }, "not_allowed"],
    ["without a station", { entry: { kind: "empty" } }, "no_station"],
    ["to a station that is not there", { entry: { kind: "unknown", digits: "99" } }, "unknown_station"],
    [
      "to a station that is not for it, though nothing was asked",
      { entry: { kind: "wrong_type", station: { number: 15 } as Station }, preview: { kind: "none" } },
      "wrong_type",
    ],
    [
      "while it drives without an order",
      { vehicle: { id: "TP-01", leg: {}, activity: "moving" } as Vehicle, preview: { kind: "none" } },
      "on_its_way",
    ],
    [
      "behind another order, though it drives",
      { vehicle: { id: "TP-01", leg: {}, activity: "moving" } as Vehicle, busy: true },
      "ready",
    ],
    [
      "where it stands already",
      {
        preview: {
          kind: "ready",
          data: data({
            steps: [
              {
                ...data().steps[0]!,
                options: [{ ...option("linear", false), reason: { code: "already_there", params: {} } }],
              },
            ],
          }),
        },
      },
      "problem",
    ],
    [
      "while it waits for its own start",
      { vehicle: { id: "TP-01", leg: {}, activity: "waiting" } as Vehicle },
      "ready",
    ],
    ["while it is asked again", { preview: { kind: "loading", last: data() } }, "waiting"],
    ["with a failed check", { preview: { kind: "ready", data: data({ checks: all() }) } }, "check"],
    [
      "when the server would refuse",
      { preview: { kind: "ready", data: data({ accepted: false, problem: { code: "x", params: {} } }) } },
      "problem",
    ],
    [
      "when it would refuse without a word",
      { preview: { kind: "ready", data: data({ accepted: false }) } },
      "failed",
    ],
  ])("%s", (_, change, kind) => expect(readiness({ ...ok, ...change }).kind).toBe(kind));
  it("holds the move that leads over closed floor", () => {
    const floor = { code: "floor", result: "fail", params: {} } as const;
    expect(readiness({ ...ok, floor })).toEqual({ kind: "check", check: floor });
    expect(readiness({ ...ok, floor: { ...floor, result: "pass" } }).kind).toBe("ready");
  });
  it("holds the move whose brackets cannot go where they are to go on arrival", () =>
    expect(readiness({ ...ok, brackets: "bad_height" })).toEqual({ kind: "brackets", fault: "bad_height" }));
  it("names the infeasible mode before its check", () => {
    expect(readiness({ ...ok, mode: "auto", preview: { kind: "ready", data: data() } }).kind).toBe("ready");
    expect(readiness({ ...ok, mode: "self_rotation" as never }).kind).toBe("infeasible");
  });
  function all(): Check[] {
    return [check("link", "pass"), check("safety", "fail")];
  }
});
