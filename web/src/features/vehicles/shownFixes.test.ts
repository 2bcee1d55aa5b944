import { expect, it } from "vitest";
import { shownFixes, type Fix } from "./shownFixes";

const fix = (code: string, result: Fix["result"] = "taken"): Fix => ({
  by: "codes",
  code,
  result,
  moved_m: 0.001,
  turned_rad: 0,
  times: 1,
  at: "2026-11-28T10:00:00Z",
});
const codes = (fixes: readonly Fix[]) => fixes.map((f) => f.code).join("");

it("shows the newest", () => {
  expect(codes(shownFixes([], 3))).toBe("");
  expect(
    codes(
      shownFixes(
        ["a", "b", "c", "d"].map((c) => fix(c)),
        3,
      ),
    ),
  ).toBe("abc");
});

it("shows the newest one that was refused, however old", () => {
  const fixes = [fix("a"), fix("b"), fix("c"), fix("d", "refused"), fix("e", "begun_anew")];
  expect(codes(shownFixes(fixes, 3))).toBe("abd");
  expect(codes(shownFixes([fix("a", "refused"), ...fixes], 3))).toBe("aab");
});
