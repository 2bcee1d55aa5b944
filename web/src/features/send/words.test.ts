import { readdirSync, readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import type { Check, MotionMode, Plant, Reason, StationState, Vehicle } from "@/shared/api/types";
import rawReasonsEn from "@/shared/words/catalogs/reasons.en.json";
import rawReasonsZh from "@/shared/words/catalogs/reasons.zh.json";
import wordsEn from "@/shared/words/catalogs/words.en.json";
import wordsZh from "@/shared/words/catalogs/words.zh.json";
import sprite from "@/shared/ui/sprite.svg?raw";
import { noNames } from "@/shared/words/sentence";
import { checksSummary, checkWords } from "./steps/checkWords";
import en from "./i18n.en.json";
import zh from "./i18n.zh.json";
import { modeIcon } from "./steps/ModeStep";
import { deviationValues, moveWords, type Segment } from "./preview/moveWords";
import { dimension, wayOf } from "./preview/moveGeometry";
import { isTyping, pressKey, padKeyOf } from "@/shared/ui/padKeys";
import { lookUpStation } from "./steps/stationEntry";
import { numberRanges } from "./steps/StationStep";

const reasonsEn: Record<string, string> = rawReasonsEn;
const reasonsZh: Record<string, string> = rawReasonsZh;
const at = (key: string): unknown =>
  key.split(".").reduce<unknown>((o, k) => (o as Record<string, unknown>)?.[k], en);
const template = (key: string) => (typeof at(key) === "string" ? (at(key) as string) : undefined);
const say = (key: string, params: Record<string, unknown>) =>
  (template(key) ?? key).replace(/\{\{(\w+)\}\}/g, (_, name: string) => String(params[name]));
const pose = { x_m: 0, y_m: 0, heading_rad: 0 };
const segment = (over: Partial<Segment>): Segment => ({
  kind: "straight",
  start: pose,
  end: pose,
  turn_rad: 0,
  length_m: 0,
  duration_s: 1,
  ...over,
});

describe("the line of the checks", () => {
  const from =
    (catalog: object) =>
    (key: string, params: Record<string, unknown> = {}) =>
      String(key.split(".").reduce<unknown>((o, k) => (o as Record<string, unknown>)[k], catalog)).replace(
        /\{\{(\w+)\}\}/g,
        (_, name: string) => String(params[name]),
      );
  it.each([
    [["link pass", "load pass"], "All 2 pass", "2 项全部通过"],
    [["link pass", "load pass", "wheels note"], "1 to note, 2 pass", "1 项须留意，2 项通过"],
    [
      ["link pass", "station note", "wheels note"],
      "1 to wait for, 1 to note, 1 pass",
      "1 项须等待，1 项须留意，1 项通过",
    ],
    [["station note"], "1 to wait for", "1 项须等待"],
    [
      ["safety fail", "clearance note", "link pass"],
      "1 failed, 1 to wait for, 1 pass",
      "1 项未通过，1 项须等待，1 项通过",
    ],
  ])("of %j is %s", (made, inEnglish, inChinese) => {
    const checks = made.map((one) => {
      const [code, result] = one.split(" ");
      return { code, result, params: {} } as Check;
    });
    expect([checksSummary(checks, from(en)), checksSummary(checks, from(zh))]).toEqual([
      inEnglish,
      inChinese,
    ]);
  });
});

describe("moveWords", () => {
  it("says what the wheels will do", () => {
    const segments = [
      segment({ kind: "rotate", turn_rad: -0.0017453 }),
      segment({ length_m: 10.0028, direction_rad: 0 }),
      segment({ kind: "rotate", turn_rad: Math.PI / 2 }),
    ];

    expect(moveWords(segments, say, ", ")).toBe("drive 10.003 m, turn 90.0° left");
  });
  it.each([
    [{ length_m: 2, direction_rad: Math.PI }, "reverse 2.000 m"],
    [{ length_m: -2, direction_rad: 0 }, "reverse 2.000 m"],
    [{ length_m: 2, direction_rad: Math.PI / 2 }, "move 2.000 m left"],
    [{ length_m: 2, direction_rad: -Math.PI / 2 }, "move 2.000 m right"],
    [{ length_m: 5, direction_rad: Math.PI / 6 }, "move 5.000 m, 30.0° to the left"],
    [{ length_m: -5, direction_rad: -(3 * Math.PI) / 4 }, "move 5.000 m, 135.0° to the right"],
    [
      { kind: "combined" as const, turn_rad: -Math.PI / 2, length_m: 4 },
      "move 4.000 m, turning 90.0° right on the way",
    ],
    [{ kind: "combined" as const, turn_rad: 0.0002, length_m: 15.881 }, "move 15.881 m"],
    [{ kind: "arc" as const, turn_rad: Math.PI / 2, length_m: 5 * Math.PI }, "arc 90.0° left, radius 10.0 m"],
    [
      { kind: "arc" as const, turn_rad: -Math.PI, length_m: -10 * Math.PI },
      "arc 180.0° right backwards, radius 10.0 m",
    ],
  ])("%o is %s", (over, words) => expect(moveWords([segment(over)], say, ", ")).toBe(words));
  it("reads the pieces of one arc as one, and another arc apart", () => {
    const piece = {
      kind: "arc" as const,
      turn_rad: Math.PI / 4,
      length_m: 2.5 * Math.PI,
      centre: { x_m: 1, y_m: 2 },
    };
    const other = { ...piece, centre: { x_m: 9, y_m: 2 } };

    expect(moveWords([segment(piece), segment(piece)], say, ", ")).toBe("arc 90.0° left, radius 10.0 m");
    expect(moveWords([segment(piece), segment(other)], say, ", ").match(/arc/g)).toHaveLength(2);
  });
  it("reads half a turn, which is ordered as two, as one", () => {
    const quarter = segment({ kind: "rotate", turn_rad: -Math.PI / 2 });

    expect(moveWords([quarter, quarter], say, ", ")).toBe("turn 180.0° right");
    expect(moveWords([quarter, { ...quarter, turn_rad: 0.5 }], say, ", ").match(/turn/g)).toHaveLength(2);
  });
  it("reads the pieces of one turn on the way as one", () => {
    const piece = { kind: "combined" as const, turn_rad: Math.PI / 3, length_m: 2 };

    expect(moveWords([segment(piece), segment(piece)], say, ", ")).toBe(
      "move 4.000 m, turning 120.0° left on the way",
    );
  });
  it("leaves out a turn that is the machine's business, unless it is all there is", () => {
    const tiny = segment({ kind: "rotate", turn_rad: -0.0006 });

    expect(moveWords([tiny, segment({ length_m: 2, direction_rad: 0 })], say, ", ")).toBe("drive 2.000 m");
    expect(moveWords([tiny], say, ", ")).toBe("turn 0.034° right");
  });
});

describe("modes", () => {
  const modes = Object.keys(modeIcon) as MotionMode[];

  it.each(modes)("%s has a name in both languages and a picture", (mode) => {
    for (const words of [wordsEn, wordsZh]) {
      expect(words.mode[mode]).toBeTruthy();
      expect(words.mode_short[mode]).toBeTruthy();
    }
    expect(sprite).toContain(`id="${modeIcon[mode]}"`);
  });

  // What the planner may say against a mode, read from its sources: a new code must not reach people as a code.
  const root = new URL("../../../../core/", import.meta.url);
  const sources = ["kinematics", "planning", "fleet/views"].flatMap((folder) =>
    readdirSync(new URL(folder, root), { recursive: true, encoding: "utf8" })
      .filter((name) => name.endsWith(".cpp") && (folder !== "fleet/views" || name === "motion_preview.cpp"))
      .map((name) => readFileSync(new URL(`${folder}/${name}`, root), "utf8")),
  );
  const codes = new Set(
    sources.flatMap((text) =>
      [...text.matchAll(/(?:Errc::k\w+,\s*\{?|return \{|Reason\{)"([a-z_]+)"/g)].map((found) => found[1]),
    ),
  );

  it("are refused for reasons that the sources name", () => {
    const known = ["mode_not_supported", "not_beside", "cannot_move_so", "blocked", "no_route"];
    for (const code of known) expect(codes).toContain(code);
  });
  it.each([...codes])("the reason %s has words in both languages", (code) => {
    for (const reasons of [reasonsEn, reasonsZh]) {
      const said = ["", "_b", "_c", "_d"].map((variant) => reasons[`${code}${variant}`]).filter(Boolean);
      expect(said.length, code).toBeGreaterThan(0);
    }
  });
  it("show the expected deviation in mm and degrees", () => {
    expect(deviationValues({ position_m: 0.0042, heading_rad: 0.002, arrivals: 7 })).toEqual({
      count: 7,
      position: "4.2",
      heading: "0.11",
    });
    expect(deviationValues({ position_m: 0.0312, heading_rad: 0, arrivals: 0 })).toEqual({
      count: 0,
      position: "31",
      heading: "0.00",
    });
  });
});

describe("checkWords", () => {
  const t = (key: string, values?: Record<string, unknown>) =>
    template(key.replace(/^send:/, "")) ?? String(values?.["defaultValue"] ?? key);
  const words = (check: Partial<Check>) =>
    checkWords(
      { code: "load", result: "pass", params: {}, ...check } as Check,
      noNames,
      t,
      (r: Reason) => `why ${r.code}`,
    );
  it.each<[Partial<Check>, string]>([
    [
      { code: "load", params: { total_n: 215700, unbalance: 0.031 } },
      "215.7\u00a0kN, brackets within 3.1\u00a0%",
    ],
    [{ code: "load", params: { total_n: 12, unbalance: 0 } }, "No load"],
    [
      {
        code: "load",
        result: "fail",
        params: { total_n: 196133, reason: "load_unbalanced", unbalance: 0.11, limit: 0.1 },
      },
      "196.1\u00a0kN: why load_unbalanced",
    ],
    [
      { code: "clearance", params: { clearance_m: 2.25, limit_m: 0.5, nearest: "A-104" } },
      "2.25\u00a0m to A-104, limit 0.50\u00a0m",
    ],
    [
      { code: "pose", params: { dx_m: -0.0028, dy_m: -0.0002, dheading_rad: 0.00173 } },
      "−2.8 mm, −0.2 mm, +0.099°",
    ],
    [
      { code: "parking_feet", result: "fail", params: { furthest_m: 0.12, feet: 4 } },
      "On the floor: 0.12\u00a0m out",
    ],
    [{ code: "mode", result: "note", params: { reason: "vehicle_busy" } }, "why vehicle_busy"],
    [{ code: "codes_in_view", params: { back: "B", found: 1, cameras: 2 } }, "1 of 2 cameras see a code"],
  ])("%o", (check, text) => expect(words(check).replaceAll("\u2009", "\u00a0")).toBe(text));
  it("gives a reason its fault as the vehicle names it", () => {
    const check = {
      code: "mode",
      result: "fail",
      params: { reason: "wheel_fault", wheel: "front drive", fault: "steering_drive_fault" },
    } as unknown as Check;
    const inWords = (key: string, values?: Record<string, unknown>) =>
      key === "faults:steering_drive_fault" ? "fault of the steering drive" : t(key, values);
    const reason = (r: Reason) => `${r.params["wheel"]}: ${r.params["fault"]}`;
    expect(checkWords(check, noNames, inWords, reason)).toBe("front drive: steering_drive_fault");
    expect(checkWords({ ...check, code: "wheels" }, noNames, inWords, reason)).toBe(
      "Wheel front drive: fault of the steering drive",
    );
  });
  it("shows what it carries when it has no words for it", () => {
    expect(words({ code: "battery", result: "pass", params: { charge_percent: 50 } })).toContain("charge 50");
  });
});

describe("station number", () => {
  const station = (number: number, vehicle_types: string[] = []) => ({
    id: `s${number}`,
    number,
    name: `N${number}`,
    vehicle_types,
  });
  const plant = { stations: [station(6), station(7), station(8, ["cart"])] } as unknown as Plant;
  const vehicle = { id: "TP-01", type: "platform", at_station: "s6" } as Vehicle;
  const state = (over: Partial<StationState>): StationState[] => [
    { station: "s7", number: 7, occupied_by: "", reserved_by: "", ready: false, ...over },
  ];
  it.each([
    ["", [], "empty"],
    ["9", [], "unknown"],
    ["6", [], "here"],
    ["7", [], "free"],
    ["8", [], "wrong_type"],
    ["7", state({ occupied_by: "TP-02" }), "occupied"],
    ["7", state({ reserved_by: "TP-02" }), "reserved"],
    ["7", state({ reserved_by: "TP-01" }), "free"],
  ])("%s is %s: %s", (digits, states, kind) =>
    expect(lookUpStation(digits, plant, states, vehicle).kind).toBe(kind),
  );
  it("takes at most four digits, no leading zero, and can be put right", () => {
    expect("12345".split("").reduce((d, k) => pressKey(d, k as "1"), "")).toBe("1234");
    expect(pressKey("0", "7")).toBe("7");
    expect(pressKey("12", "delete")).toBe("1");
    expect(pressKey("12", "clear")).toBe("");
    expect(padKeyOf("a")).toBeUndefined();
    for (const tagName of ["INPUT", "TEXTAREA", "SELECT"]) expect(isTyping({ tagName })).toBe(true);
    expect([isTyping({ tagName: "BODY" }), isTyping(null)]).toEqual([false, false]);
  });
  it("names the numbers there are", () =>
    expect(numberRanges([3, 1, 2, 7, 31, 32])).toBe("1\u20133, 7, 31\u201332"));
});

describe("preview geometry", () => {
  it("follows an arc by chords that end where it ends", () => {
    const way = wayOf([
      {
        kind: "arc",
        start: { x_m: 10, y_m: 0, heading_rad: 0 },
        end: { x_m: 0, y_m: 10, heading_rad: 0 },
        turn_rad: Math.PI / 2,
        centre: { x_m: 0, y_m: 0 },
      },
    ]);

    expect(way.at(-1)).toEqual({ x_m: 0, y_m: 10 });
    expect(way.every((p) => Math.abs(Math.hypot(p.x_m, p.y_m) - 10) < 1e-9)).toBe(true);
  });
  it("puts the dimension outside the swept area, on its nearer side", () => {
    const swept = [
      [
        { x_m: 0, y_m: -3 },
        { x_m: 10, y_m: -3 },
        { x_m: 10, y_m: 9 },
        { x_m: 0, y_m: 9 },
      ],
    ];

    expect(
      dimension(
        [
          { x_m: 0, y_m: 0 },
          { x_m: 10, y_m: 0 },
        ],
        swept,
      )?.from.y_m,
    ).toBeLessThan(-3);
  });
});
