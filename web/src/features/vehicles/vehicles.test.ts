import { describe, expect, it } from "vitest";
import type { Plant, Vehicle, VehicleType } from "@/shared/api/types";
import { footCorner, onSheet, sheetOf } from "@/shared/body/drawing/faceplate";
import { canApply } from "./integration";
import { parseNumber } from "@/shared/words/parseNumber";
import { draftOf, emptyDraft, readDraft } from "./initPosition";
import { summarise, titleOf } from "@/shared/body/drawing/loads";
import { shownCameras } from "@/shared/body/shownCameras";
import { byUrgency } from "./urgency";
import { newest } from "./useHeard";
import { whyRows } from "./whyRows";

const type = {
  footprint: [
    { x_m: -5.25, y_m: -1.25 },
    { x_m: 5.25, y_m: 1.25 },
  ],
  brackets: [
    { name: "front left", position: { x_m: 3, y_m: 1 } },
    { name: "front right", position: { x_m: 3, y_m: -1 } },
    { name: "back left", position: { x_m: -3, y_m: 1 } },
    { name: "back right", position: { x_m: -3, y_m: -1 } },
  ],
} as unknown as VehicleType;
const forces = (...n: number[]) =>
  type.brackets.map((b, i) => ({ name: b.name, force_a_n: n[2 * i] ?? 0, force_b_n: n[2 * i + 1] ?? 0 }));

describe("load", () => {
  const loaded = (share: number, ...n: number[]) => ({
    brackets: forces(...n),
    worst_bracket: { bracket: type.brackets[0]!.name, share, limit: 0.1 },
    ...(Math.abs(share) > 0.1 && { load_fault: { code: "load_unbalanced", params: {} } }),
  });
  it("compares a bracket with its own end, so that a load aft is balanced", () => {
    const summary = summarise(loaded(0, 1000, 1000, 1000, 1000, 3000, 3000, 3000, 3000), type);

    expect(summary).toMatchObject({ total_n: 16000, fault: undefined });
    expect(summary?.brackets.map((b) => b.a.share)).toEqual([0, 0, 0, 0]);
  });
  it.each([
    [0.09, undefined],
    [-0.11, "load_unbalanced"],
  ])("with a bracket %d off has the fault that the server says: %s", (share, fault) => {
    const summary = summarise(loaded(share, 1000, 1000, 1000, 1000, 1000, 1000, 1000, 1000), type);

    expect(summary?.fault?.code).toBe(fault);
    expect(summary).toMatchObject({ worst: Math.abs(share), limit: 0.1 });
  });
  it("does not blame the sound bracket beside one that is 40 % over", () => {
    const summary = summarise(loaded(0.17, 1400, 1400, 1000, 1000, 1000, 1000, 1000, 1000), type);

    expect(summary?.brackets.map((b) => Math.round(b.a.share * 100))).toEqual([40, 0, 0, 0]);
  });
  it("is unknown without readings", () => expect(summarise({ brackets: [] }, type)).toBeUndefined());
});

describe("title of the drawing", () => {
  const foot = { name: "front left" } as Vehicle["parking_feet"][number];
  it.each([
    ["brackets and feet", forces(1, 1), [foot], type, "loads.title"],
    ["brackets that tell nothing yet", [], [foot], type, "loads.title"],
    ["brackets without feet", forces(1, 1), [], type, "loads.title_load"],
    ["feet without brackets", [], [foot], { brackets: [] }, "loads.title_feet"],
    ["neither, as all but the platform", [], [], { brackets: [] }, "loads.title_wheels"],
  ])("names what a vehicle has: %s", (_, brackets, parking_feet, of, title) => {
    expect(titleOf({ brackets, parking_feet }, of)).toBe(title);
  });
});

describe("drawing", () => {
  it("has forward on the right and left on top", () => {
    const sheet = sheetOf(type);
    const front = onSheet(sheet, { x_m: 5, y_m: 1 });

    expect(parseFloat(front.left)).toBeGreaterThan(50);
    expect(parseFloat(front.top)).toBeLessThan(50);
  });
  it("holds a body that is not as long as it is wide", () => {
    const square = sheetOf({
      footprint: [
        { x_m: -0.5, y_m: -0.5 },
        { x_m: 0.5, y_m: 0.5 },
      ],
    } as VehicleType);

    expect(square.height / 2).toBeGreaterThan(0.5 * 1.2);
    expect(square.width / 2).toBeGreaterThan(0.5 * 1.2);
    expect(square.scale).toBeLessThan(0.3);
    expect(sheetOf(type).scale).toBeCloseTo(1, 2);
  });
  it.each([
    ["front left", 3, { x: 1, y: 1 }],
    ["back_right", 0, { x: -1, y: -1 }],
    ["FL", 2, { x: 1, y: 1 }],
    ["BR", 0, { x: -1, y: -1 }],
    ["P3", 2, { x: -1, y: 1 }],
  ])("foot %s stands at its corner", (name, index, corner) =>
    expect(footCorner(name, index)).toEqual(corner),
  );
});

describe("initial position", () => {
  const pose = { x_m: 10, y_m: 20, heading_rad: 1 };
  const plant = { stations: [{ number: 7, pose }] } as unknown as Plant;
  it.each([
    ["84,997.24", 84997.24],
    ["−12,5", -12.5],
    ["+3", 3],
    ["84 997", 84997],
    ["1,234", 1234],
    ["", undefined],
    ["1e3", undefined],
    ["abc", undefined],
    ["1.2.3", undefined],
  ])("reads %s", (text, value) => expect(parseNumber(text)).toBe(value));
  it.each([
    [{ station: "7" }, { kind: "pose", pose }],
    [{ station: "9" }, { kind: "bad_station", number: "9" }],
    [{ station: "" }, { kind: "empty" }],
    [{ how: "numbers" as const, x_mm: "1", y_mm: "2", heading_deg: "361" }, { kind: "bad_heading" }],
    [
      { how: "numbers" as const, x_mm: "1", y_mm: "b", heading_deg: "0" },
      { kind: "bad_number", field: "y" },
    ],
    [
      { how: "numbers" as const, x_mm: "1500", y_mm: "-2000", heading_deg: "180" },
      { kind: "pose", pose: { x_m: 1.5, y_m: -2, heading_rad: Math.PI } },
    ],
    [
      { how: "numbers" as const, x_mm: "1500", y_mm: "-2000", heading_deg: "180", measured: true },
      {
        kind: "pose",
        pose: { x_m: 1.5, y_m: -2, heading_rad: Math.PI, within_m: 0.01, within_rad: Math.PI / 1800 },
      },
    ],
    [
      { station: "7", measured: true },
      { kind: "pose", pose },
    ],
  ])("%o", (draft, result) => expect(readDraft({ ...emptyDraft, ...draft }, plant)).toEqual(result));

  it("takes over a pose that the vehicle claims", () => {
    const read = readDraft(draftOf({ x_m: 12.3456, y_m: -0.5, heading_rad: Math.PI / 2 }), plant);
    expect(read.kind).toBe("pose");
    if (read.kind !== "pose") return;
    expect(read.pose.x_m).toBeCloseTo(12.3456, 4);
    expect(read.pose.y_m).toBeCloseTo(-0.5, 4);
    expect(read.pose.heading_rad).toBeCloseTo(Math.PI / 2, 4);
  });
});

describe("why it stands", () => {
  const vehicle = {
    id: "TP-01",
    link: "live",
    needs_resume: false,
    integration: "utilise",
    errors: [],
    brackets: [],
    wheels: [],
    parking_feet: [],
  } as unknown as Vehicle;
  const wheel = (temperature_c: number, fault = "") => ({
    name: "FL",
    steering_rad: 0,
    speed_mps: 0,
    temperature_c,
    warm: temperature_c >= 65,
    fault,
  });
  it("puts what holds it on top", () => {
    const rows = whyRows({ ...vehicle, needs_resume: true, wheels: [wheel(70)] }, type, undefined, false);

    expect(rows.map((r) => `${r.kind} ${r.result}`)).toEqual(["resume fail", "wheel note", "link pass"]);
  });
  it("does not call its own reservation taken", () => {
    const state = { station: "s", number: 7, occupied_by: "", reserved_by: "TP-01", ready: false };

    expect(whyRows(vehicle, type, state, false).find((r) => r.kind === "station")?.result).toBe("pass");
    expect(
      whyRows(vehicle, type, { ...state, reserved_by: "TP-02" }, false).find((r) => r.kind === "station")
        ?.result,
    ).toBe("note");
  });
  it("passes no connection whose data is old, whatever the server said last", () => {
    const link = (stale: boolean) => whyRows(vehicle, type, undefined, stale).find((r) => r.kind === "link");
    expect(link(false)?.result).toBe("pass");
    expect(link(true)?.result).toBe("note");
  });
  it("calls silence and a wheel fault what they are", () => {
    const rows = whyRows(
      { ...vehicle, link: "lost", wheels: [wheel(30, "encoder")] },
      type,
      undefined,
      false,
    );

    expect(rows.map((r) => r.result)).toEqual(["fail", "fail"]);
  });
});

describe("newest word", () => {
  const now = Date.parse("2026-01-01T00:00:10Z");
  const vehicle = {
    pose: { x_m: 1, y_m: 1, heading_rad: 0 },
    pose_at: "2026-01-01T00:00:05Z",
    last_heard_at: "2026-01-01T00:00:06Z",
  } as Vehicle;
  it("is the stream's when that is younger", () => {
    const heard = newest(vehicle, { x_m: 2, y_m: 2, heading_rad: 0, speed_mps: 0.3, age_s: 0.1 }, now);

    expect(heard).toMatchObject({ pose: { x_m: 2 }, speed_mps: 0.3, pose_s: 0.1, heard_s: 0.1 });
  });
  it("is the record's when the stream is silent", () => {
    const heard = newest(vehicle, { x_m: 2, y_m: 2, heading_rad: 0, speed_mps: 0.3, age_s: 60 }, now);

    expect(heard).toMatchObject({ pose: { x_m: 1 }, pose_s: 5, heard_s: 4 });
  });
});

describe("taking a vehicle out", () => {
  it("asks for a word that it is out of the hall before its floor is freed", () => {
    expect(canApply("utilise", "notice", false)).toBe("confirm_first");
    expect(canApply("respect", "ignore", true)).toBe("yes");
    expect(canApply("ignore", "notice", false)).toBe("yes");
  });
  it("needs nothing more for what keeps the floor", () => {
    expect(canApply("utilise", "respect", false)).toBe("yes");
    expect(canApply("respect", "respect", false)).toBe("same");
  });
});

describe("list of vehicles", () => {
  const vehicle = (name: string, over: Partial<Vehicle> = {}) =>
    ({
      id: name,
      name,
      link: "live",
      activity: "standing",
      integration: "utilise",
      pose_known: true,
      wheels: [],
      errors: [],
      parking_feet: [],
      ...over,
    }) as unknown as Vehicle;
  it("has the one on fire first, then what waits, moves and stands, each by name", () => {
    const all = [
      vehicle("DL-10"),
      vehicle("DL-9"),
      vehicle("MV-01", { activity: "moving" }),
      vehicle("MV-02", { activity: "waiting" }),
      vehicle("OM-01", { link: "late" }),
      vehicle("OM-02", { pose_known: false }),
      vehicle("TP-09", { e_stop: "MANUAL" }),
    ];

    expect(byUrgency(all, 0).map((v) => v.name)).toEqual([
      "TP-09",
      "OM-02",
      "OM-01",
      "MV-02",
      "MV-01",
      "DL-9",
      "DL-10",
    ]);
  });
});

describe("cameras", () => {
  const type = { cameras: [{ name: "front" }, { name: "back" }] } as unknown as VehicleType;
  it("are all there, also while the vehicle reports none", () => {
    const front = { name: "front", found: true } as Vehicle["cameras"][number];

    expect(shownCameras({ cameras: [] }, type).map((c) => c.name)).toEqual(["front", "back"]);
    expect(shownCameras({ cameras: [front] }, type)).toEqual([
      { name: "front", camera: front },
      { name: "back", camera: undefined },
    ]);
    expect(shownCameras({ cameras: [front] }, undefined)).toHaveLength(1);
  });
});
