import { describe, expect, it } from "vitest";
import type { NewJobOrder } from "@/shared/api/types";
import {
  armedLeft_s,
  kArmMs,
  kDwellMs,
  startCommand,
  type StartCommand,
  type StartEvent,
} from "./startCommand";

const body: NewJobOrder = { vehicle: "TP-01", priority: 0, steps: [{ station: 7, motion_mode: "linear" }] };
const other: NewJobOrder = { ...body, steps: [{ station: 6, motion_mode: "linear" }] };
const idle: StartCommand = { kind: "idle" };
const armed: StartCommand = { kind: "armed", key: "k", body, sinceMs: 1000 };
const requested: StartCommand = { kind: "requested", key: "k", body, sinceMs: 3000, tries: 1 };
const unanswered: StartCommand = { kind: "unanswered", key: "k", body, tries: 1, why: "timeout" };
const problem = { code: "vehicle_gone", params: {}, detail: "", requestId: "" };
const run = (state: StartCommand, ...events: StartEvent[]) => events.reduce(startCommand, state);

describe("startCommand", () => {
  it("starts with the key and the body made when it was armed", () => {
    const state = run(idle, { kind: "arm", key: "k", body, nowMs: 1000 }, { kind: "start", nowMs: 3000 });

    expect(state).toEqual(requested);
  });
  it("takes a double tap on arming for one press", () => {
    const state = run(
      idle,
      { kind: "arm", key: "k", body, nowMs: 1000 },
      { kind: "start", nowMs: 1000 + kDwellMs - 1 },
    );

    expect(state.kind).toBe("armed");
  });
  it("ignores every further press once requested", () => {
    const state = run(
      requested,
      { kind: "start", nowMs: 3100 },
      { kind: "hold", key: "x", body, nowMs: 3200 },
      {
        kind: "arm",
        key: "y",
        body,
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
    expect(run(unanswered, { kind: "arm", key: "x", body: other, nowMs: 9000 })).toBe(unanswered);
    expect(run(unanswered, { kind: "cancel" })).toBe(unanswered);
  });
  it.each<[string, StartEvent, StartCommand["kind"]]>([
    ["lapses after 8 s", { kind: "tick", nowMs: 1000 + kArmMs }, "idle"],
    ["stays before 8 s", { kind: "tick", nowMs: 999 + kArmMs }, "armed"],
    ["is not started after 8 s", { kind: "start", nowMs: 1000 + kArmMs }, "idle"],
    ["lapses when something else would be sent", { kind: "subject", body: other }, "idle"],
    ["lapses when nothing may be sent", { kind: "subject", body: undefined }, "idle"],
    ["stays while the same would be sent", { kind: "subject", body: { ...body } }, "armed"],
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
  it("shows what is left of the arming", () => {
    expect(armedLeft_s(armed, 3000)).toBe(6);
    expect(armedLeft_s(armed, 99000)).toBe(0);
    expect(armedLeft_s(idle, 0)).toBe(0);
  });
});
