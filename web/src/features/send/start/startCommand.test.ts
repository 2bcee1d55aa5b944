import { describe, expect, it } from "vitest";
import type { NewJobOrder } from "@/shared/api/types";
import { kArmMs, kDoubleTapMs } from "@/shared/ui/arming";
import { armedLeft_s, startCommand, type StartCommand, type StartEvent, type Subject } from "./startCommand";

const body: NewJobOrder = { vehicle: "TP-01", priority: 0, steps: [{ station: 7, motion_mode: "linear" }] };
const other: NewJobOrder = { ...body, steps: [{ station: 6, motion_mode: "linear" }] };
const subject: Subject = { body, after: "" };
const idle: StartCommand = { kind: "idle" };
const armed: StartCommand = { kind: "armed", key: "k", subject, sinceMs: 1000 };
const requested: StartCommand = { kind: "requested", key: "k", body, sinceMs: 3000, tries: 1 };
const unanswered: StartCommand = { kind: "unanswered", key: "k", body, tries: 1, why: "timeout" };
const problem = { code: "vehicle_gone", params: {}, detail: "", requestId: "" };
const run = (state: StartCommand, ...events: StartEvent[]) => events.reduce(startCommand, state);

describe("startCommand", () => {
  it("starts with the key and the body made when it was armed", () => {
    const state = run(idle, { kind: "arm", key: "k", subject, nowMs: 1000 }, { kind: "start", nowMs: 3000 });

    expect(state).toEqual(requested);
  });
  it("takes a double tap on arming for one press", () => {
    const state = run(
      idle,
      { kind: "arm", key: "k", subject, nowMs: 1000 },
      { kind: "start", nowMs: 1000 + kDoubleTapMs - 1 },
    );

    expect(state.kind).toBe("armed");
  });
  it("ignores every further press once requested", () => {
    const state = run(
      requested,
      { kind: "start", nowMs: 3100 },
      { kind: "hold", key: "x", subject, nowMs: 3200 },
      {
        kind: "arm",
        key: "y",
        subject,
        nowMs: 3300,
      },
    );

    expect(state).toBe(requested);
  });
  it("asks again with the same key and body", () => {
    const state = run(unanswered, { kind: "retry", nowMs: 9000 });

    expect(state).toMatchObject({ kind: "requested", key: "k", body, tries: 2 });
  });
  it("does not arm anything new while nobody knows whether the last one is stored", () => {
    expect(run(unanswered, { kind: "arm", key: "x", subject: { body: other, after: "" }, nowMs: 9000 })).toBe(
      unanswered,
    );
    expect(run(unanswered, { kind: "cancel" })).toBe(unanswered);
  });
  it.each<[string, StartEvent, StartCommand["kind"]]>([
    ["lapses after 8 s", { kind: "tick", nowMs: 1000 + kArmMs }, "idle"],
    ["stays before 8 s", { kind: "tick", nowMs: 999 + kArmMs }, "armed"],
    ["is not started after 8 s", { kind: "start", nowMs: 1000 + kArmMs }, "idle"],
    [
      "lapses when something else would be sent",
      { kind: "subject", subject: { body: other, after: "" } },
      "idle",
    ],
    ["lapses when nothing may be sent", { kind: "subject", subject: undefined }, "idle"],
    [
      "stays while the same would be sent",
      { kind: "subject", subject: { body: { ...body }, after: "" } },
      "armed",
    ],
    [
      "lapses when another's order comes between",
      { kind: "subject", subject: { body, after: "o7" } },
      "idle",
    ],
    ["is cancelled", { kind: "cancel" }, "idle"],
    ["cannot be accepted unasked", { kind: "accepted", orderId: "o", vehicle: "", station: 7 }, "armed"],
    ["cannot be refused unasked", { kind: "refused", problem }, "armed"],
  ])("armed %s", (_, event, kind) => expect(startCommand(armed, event).kind).toBe(kind));
  it.each<[string, StartEvent, StartCommand["kind"]]>([
    ["accepted", { kind: "accepted", orderId: "o", vehicle: "TP-01", station: 7 }, "accepted"],
    ["refused", { kind: "refused", problem }, "refused"],
    ["unanswered", { kind: "unanswered", why: "network" }, "unanswered"],
    ["done by mistake", { kind: "done" }, "requested"],
    ["cancelled too late", { kind: "cancel" }, "requested"],
  ])("requested %s", (_, event, kind) => expect(startCommand(requested, event).kind).toBe(kind));
  describe("Replace", () => {
    const replaces = { id: "o7", name: "JO-7", created_by: "anna" };
    const event: StartEvent = { kind: "replace", key: "r", body, order: replaces, nowMs: 3000 };
    const replacing = { kind: "requested", key: "r", body, sinceMs: 3000, tries: 1, replaces } as const;
    it.each<[string, StartCommand, StartCommand]>([
      ["is asked", idle, replacing],
      ["takes the place of an arming", armed, replacing],
      ["pressed again is the same command", replacing, replacing],
      ["waits for the answer to another command", requested, requested],
      ["waits while nobody knows whether the last one is stored", unanswered, unanswered],
    ])("%s", (_, state, then) => expect(startCommand(state, event)).toEqual(then));
    it("is asked again for the same two orders, and names the other when it is refused", () => {
      const again = run(replacing, { kind: "unanswered", why: "network" }, { kind: "retry", nowMs: 9000 });

      expect(again).toEqual({ ...replacing, sinceMs: 9000, tries: 2 });
      expect(run(again, { kind: "refused", problem })).toEqual({ kind: "refused", problem, replaces });
    });
  });
  it("shows what is left of the arming", () => {
    expect(armedLeft_s(armed, 3000)).toBe(6);
    expect(armedLeft_s(armed, 99000)).toBe(0);
    expect(armedLeft_s(idle, 0)).toBe(0);
  });
});
