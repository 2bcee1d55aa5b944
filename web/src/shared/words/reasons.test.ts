import i18next from "i18next";
import { beforeAll, describe, expect, it } from "vitest";
import faults from "@/shared/words/catalogs/faults.en.json";
import en from "@/shared/words/catalogs/reasons.en.json";
import { problemText, reasonText } from "./reasons";
import type { Translate } from "./sentence";
import zh from "@/shared/words/catalogs/reasons.zh.json";

let t: Translate;
beforeAll(async () => {
  await i18next.init({
    lng: "en",
    resources: { en: { reasons: en, faults }, zh: { reasons: zh } },
    interpolation: { escapeValue: false, skipOnVariables: true },
  });
  t = (key, values) => i18next.t(key, values ?? {});
});

describe("reasonText", () => {
  it("fills a sentence with its values", () => {
    expect(reasonText({ code: "floor_held", params: { vehicle: "TP-02" } }, t)).toContain("TP-02");
  });
  it("takes the shorter wording when a value is missing", () => {
    const text = reasonText({ code: "floor_held", params: {} }, t);
    expect(text).toBe(en.floor_held_c);
    expect(text).not.toContain("{{");
  });
  it("puts a cause that is itself a code into words", () => {
    const text = reasonText({ code: "needs_person", params: { cause: "server_restarted" } }, t);
    expect(text).toContain(en.server_restarted);
  });
  it.each<[string, string]>([
    ["no_marker_in_view: No camera sees a code. Drive on.", `measured: ${en.no_marker_in_view}`],
    ["no_marker_in_view", `measured: ${en.no_marker_in_view}`],
    ["brand_new: Prose in one language.", "measured"],
    ["it jammed", "measured: it jammed"],
  ])("says why a stop was not measured without the prose of the vehicle: %s", (why, end) => {
    const text = reasonText({ code: "stop_not_measured", params: { station: 40, why } }, t);
    expect(text).toBe(`The stop at station 40 could not be ${end}`);
  });
  it("has words for faults", () => {
    const text = reasonText({ code: "wheel_fault", params: { wheel: "FL", fault: "servo_overload" } }, t);
    expect(text).toBe("Wheel FL: servo overloaded");
  });
  it("shows an unknown code with all it carries", () => {
    const text = reasonText({ code: "brand_new", params: { gap_m: 0.2 } }, t);
    expect(text).toContain("brand new");
    expect(text).toContain("0.20\u00a0m");
  });
  it("does not run a value as a template", () => {
    expect(reasonText({ code: "floor_held", params: { vehicle: "{{evil}}" } }, t)).not.toContain("undefined");
  });
});

describe("problemText", () => {
  it("prefers our words, then the server's sentence", () => {
    expect(problemText({ code: "stale_revision", params: {}, detail: "x" }, t)).toBe(en.stale_revision);
    expect(problemText({ code: "brand_new", params: {}, detail: "Say this." }, t)).toBe("Say this.");
  });
});
