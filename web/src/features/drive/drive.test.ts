import { describe, expect, it, vi } from "vitest";
import type { Plant, Pose } from "@/shared/api/types";
import { HandHeld, kRepeatMs, kSlowMs } from "./handHeld";
import { nearest, wayTo } from "./target";
import { isStill, kStill, kWalk_mps, twistOf, type Direction } from "./twist";

const pressed = (...all: Direction[]) => new Set(all);

describe("twistOf", () => {
  it("adds ways and a turn, and is no faster aslant", () => {
    expect(twistOf(pressed("ahead", "turn_right"), 1)).toEqual({ vx_mps: 0.3, vy_mps: 0, turn_radps: -0.1 });
    const aslant = twistOf(pressed("back", "left"), 1);
    expect(aslant.vx_mps).toBeLessThan(0);
    expect(aslant.vy_mps).toBeGreaterThan(0);
    expect(Math.hypot(aslant.vx_mps, aslant.vy_mps)).toBeCloseTo(kWalk_mps);
  });
  it("asks for nothing where directions are opposite", () => {
    expect(isStill(twistOf(pressed("ahead", "back", "turn_left", "turn_right"), 1))).toBe(true);
  });
});

describe("wayTo", () => {
  it("is as one sees it who stands on the vehicle", () => {
    const station = { pose: { x_m: 10, y_m: 5, heading_rad: -3.1 } };
    const way = wayTo(station as never, { x_m: 10, y_m: 3, heading_rad: Math.PI / 2 });
    expect(way.ahead_m).toBeCloseTo(2);
    expect(way.left_m).toBeCloseTo(0);
    expect(way.turn_rad).toBeCloseTo(2 * Math.PI - 3.1 - Math.PI / 2);
  });
  it("offers the nearest that are for it, in its hall", () => {
    const at = (id: string, x_m: number, hall = "h", types: string[] = []) => ({
      id,
      hall,
      vehicle_types: types,
      pose: { x_m, y_m: 0, heading_rad: 0 },
    });
    const plant = {
      stations: [at("far", 9), at("other", 1, "h", ["x"]), at("near", 2, "h", ["t"]), at("hall", 0, "g")],
    } as unknown as Plant;
    const here: Pose = { x_m: 0, y_m: 0, heading_rad: 0 };
    expect(nearest(plant, "h", "t", here, 3).map((way) => way.station.id)).toEqual(["near", "far"]);
  });
});

class Line {
  bufferedAmount = 0;
  sent: Record<string, unknown>[] = [];
  onopen: (() => void) | null = null;
  onmessage: ((message: { data: string }) => void) | null = null;
  onclose: (() => void) | null = null;
  send(text: string) {
    this.sent.push(JSON.parse(text) as Record<string, unknown>);
  }
  close() {}
  answer(part: Record<string, unknown>) {
    const sequence = this.sent.at(-1)!.sequence;
    this.onmessage?.({ data: JSON.stringify({ sequence, ok: true, ...part }) });
  }
  drives() {
    return this.sent.filter((one) => one.do === "drive").map((one) => one.vx_mps);
  }
}

function taken() {
  let now = 1000;
  const lines: Line[] = [];
  const hand = new HandHeld(
    () => {
      lines.push(new Line());
      return lines.at(-1) as unknown as WebSocket;
    },
    1,
    () => now,
  );
  vi.useFakeTimers();
  hand.start();
  vi.useRealTimers();
  const line = lines[0]!;
  line.onopen?.();
  const mine = { operating_mode: "MANUAL", standing: true, mine: true, person: "ann" };
  void hand.take();
  line.answer(mine);
  return {
    hand,
    line,
    lines,
    mine,
    pass(ms: number, answered = true) {
      for (let left = ms; left > 0; left -= kRepeatMs) {
        now += kRepeatMs;
        hand.tick();
        if (answered) line.answer(mine);
      }
    },
  };
}

describe("HandHeld", () => {
  it("drives while hold and direction are pressed, and says so when either is let go", () => {
    const { hand, line, pass } = taken();
    hand.press("ahead", true);
    pass(100);
    expect(line.drives()).toEqual([]); // no hold
    hand.hold(true);
    pass(100);
    expect(line.drives()).toEqual([]); // no direction
    hand.press("ahead", true);
    pass(100);
    expect(line.drives()).toEqual([0.3, 0.3]);
    hand.hold(false);
    expect(line.drives().at(-1)).toBe(0);
    const said = line.drives().length;
    pass(1000);
    expect(line.drives().length).toBe(said);
  });

  it("does not move when the hold is pressed again with the direction still down", () => {
    const { hand, line, pass } = taken();
    hand.hold(true);
    hand.press("ahead", true);
    hand.hold(false);
    const said = line.drives().length;
    hand.hold(true);
    pass(200);
    expect(line.drives().length).toBe(said);
    expect(hand.wanted()).toEqual(kStill);
  });

  it("stays below what a line may say when keys are pressed like mad", () => {
    const { hand, line, pass } = taken();
    hand.hold(true);
    const before = line.sent.length;
    for (let i = 0; i < 20; ++i) {
      for (const way of ["ahead", "left", "turn_left"] as const) hand.press(way, true);
      pass(kRepeatMs);
      for (const way of ["ahead", "left", "turn_left"] as const) hand.press(way, false);
    }
    expect(line.drives().slice(-1)).toEqual([0]); // and stands when they are let go
    expect(line.sent.length - before).toBeLessThanOrEqual(2 * 20);
  });

  it("lets go when nothing is answered, and says that the line is slow", () => {
    const { hand, line, pass } = taken();
    hand.hold(true);
    hand.press("back", true);
    pass(kSlowMs + 2 * kRepeatMs, false);
    expect(hand.state.slow).toBe(true);
    expect(hand.state.held).toBe(false);
    const said = line.drives().length;
    pass(200, false);
    expect(line.drives().length).toBe(said);
  });

  it("sends nothing into a line that is stuck", () => {
    const { hand, line } = taken();
    hand.hold(true);
    const said = line.sent.length;
    line.bufferedAmount = 1e6;
    hand.press("ahead", true);
    hand.tick();
    expect(line.sent.length).toBe(said);
  });

  it("is not its own when another has it, and tells why", async () => {
    const { hand, line } = taken();
    hand.hold(true);
    hand.press("ahead", true);
    const other = { operating_mode: "MANUAL", standing: true, person: "bob" };
    line.answer({ ok: false, reason: "in_other_hands", params: { person: "bob" }, ...other });
    expect(hand.state).toMatchObject({ mine: false, held: false, person: "bob" });
    expect(hand.state.refused).toEqual({ code: "in_other_hands", params: { person: "bob" } });
    const back = hand.giveBack();
    line.answer({ ok: false, reason: "in_other_hands", params: { person: "bob" }, ...other });
    await expect(back).rejects.toMatchObject({ code: "in_other_hands" });
  });

  it("waits for no answer that does not come: after later ones, when the vehicle has gone, and in the end", async () => {
    const { hand, line, mine, pass } = taken();
    const overtaken = hand.take();
    void hand.take();
    line.answer(mine);
    await expect(overtaken).rejects.toMatchObject({ code: "no_answer" });
    const gone = hand.take();
    line.onmessage?.({ data: JSON.stringify({ sequence: 0, ok: false, reason: "vehicle_not_connected" }) });
    await expect(gone).rejects.toMatchObject({ code: "no_answer" });
    expect(hand.state.mine).toBe(false);
    const silent = hand.take();
    pass(6000, false);
    await expect(silent).rejects.toMatchObject({ code: "no_answer" });
  });

  it("has nothing in hand after a cut, and fails what waits", async () => {
    const { hand, line, lines } = taken();
    hand.hold(true);
    const back = hand.giveBack();
    vi.useFakeTimers();
    line.onclose?.();
    await expect(back).rejects.toMatchObject({ code: "line_cut" });
    expect(hand.state).toMatchObject({ line: "cut", mine: false, held: false });
    vi.runOnlyPendingTimers();
    vi.useRealTimers();
    expect(lines.length).toBe(2);
  });
});
