import { expect, it } from "vitest";
import { ApiProblem } from "@/shared/api";
import { outcome, overdue } from "./outcome";
import type { Asked } from "./useCommand";

const words = { what: "No answer", next: "Look" };
const stored: Asked = { kind: "stored", atMs: 1000 };

it.each<[string, Asked, number | undefined, number, string]>([
  ["nothing asked", { kind: "idle" }, undefined, 0, "ready"],
  ["asked", { kind: "requested", atMs: 0 }, undefined, 500, "requested"],
  ["stored, not reported", stored, undefined, 15_999, "accepted"],
  ["stored and never reported", stored, undefined, 16_000, "timed_out"],
  ["reported", stored, 2400, 2500, "confirmed"],
  ["reported in time and looked at late", stored, 2400, 60_000, "confirmed"],
  ["refused", { kind: "failed", problem: new ApiProblem({ status: 409, code: "x" }) }, undefined, 0, "ready"],
])("%s", (_, asked, doneMs, nowMs, kind) => {
  expect(outcome(asked, doneMs, nowMs, "TP-01", words).kind).toBe(kind);
});

it("says after how long it was confirmed", () => {
  expect(outcome(stored, 2400, 9000, "TP-01", words)).toEqual({
    kind: "confirmed",
    by: "TP-01",
    afterS: 1.4,
  });
});

it("lets nothing be under way for ever", () => {
  const underWay = { kind: "under_way", title: "Cancelling", small: "" } as const;
  expect(overdue(underWay, 0, 29_999, words)).toBe(underWay);
  expect(overdue(underWay, 0, 30_000, words)).toEqual({ kind: "timed_out", ...words });
  expect(overdue({ kind: "ready" }, 0, 60_000, words)).toEqual({ kind: "ready" });
});
