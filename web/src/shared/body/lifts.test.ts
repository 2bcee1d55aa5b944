import { describe, expect, it } from "vitest";
import type { Load, Vehicle } from "@/shared/api/types";
import { heights, liftBar, placesToSay, readHeight, readSpeed, reasonOf } from "./lifts";

describe("height of a bracket", () => {
  it("is typed in millimetres", () => {
    expect(readHeight("50", 0.3)).toEqual({ kind: "height", height_m: 0.05 });
    expect(readHeight(" 12,5 ", 0.3)).toEqual({ kind: "height", height_m: 0.0125 });
    expect(readHeight("0", 0.3)).toEqual({ kind: "height", height_m: 0 });
    expect(readHeight("300", 0.3)).toEqual({ kind: "height", height_m: 0.3 });
  });
  it("is nothing else", () => {
    expect(readHeight("  ", 0.3)).toEqual({ kind: "empty" });
    for (const text of ["-1", "300.1", "high", "1e9", "50 mm"])
      expect(readHeight(text, 0.3)).toEqual({ kind: "bad_height" });
  });
  it("of all brackets is between the lowest and the highest that tell it", () => {
    const bracket = (height_m?: number) => ({
      name: "b",
      force_a_n: 0,
      force_b_n: 0,
      ...(height_m !== undefined && { height_m }),
    });
    expect(heights([bracket(0.2), bracket(), bracket(0.1)])).toEqual({ low_m: 0.1, high_m: 0.2 });
    expect(heights([bracket()])).toBeUndefined();
  });
});

describe("speed of brackets", () => {
  it("is typed in millimetres a second, and full where nothing is", () => {
    expect(readSpeed("5", 0.01)).toEqual({ kind: "speed", speed_mps: 0.005 });
    expect(readSpeed("10", 0.01)).toEqual({ kind: "speed", speed_mps: 0.01 });
    expect(readSpeed(" ", 0.01)).toEqual({ kind: "full" });
  });
  it("is nothing else", () => {
    for (const text of ["0", "-1", "10.1", "fast"])
      expect(readSpeed(text, 0.01)).toEqual({ kind: "bad_speed" });
  });
});

describe("what keeps them", () => {
  const vehicle = (more: object) => ({ paused: false, ...more }) as unknown as Vehicle;
  const lift = { type: "lowerParking", state: "under_way" };
  it("is another movement, a pause or an order", () => {
    expect(liftBar(vehicle({}), "raiseParking")).toBeUndefined();
    expect(liftBar(vehicle({ lift }), "raiseParking")).toBe("moving");
    expect(liftBar(vehicle({ lift }), "lowerParking")).toBeUndefined();
    expect(liftBar(vehicle({ lift: { ...lift, state: "done" } }), "raiseParking")).toBeUndefined();
    expect(liftBar(vehicle({ paused: true }), "raiseParking")).toBe("paused");
    expect(liftBar(vehicle({ pause_confirmed: true }), "raiseParking")).toBe("paused");
    expect(liftBar(vehicle({ leg: {} }), "raiseParking")).toBe("busy");
  });
});

describe("why a vehicle did not get there", () => {
  it("is read from its own sentence", () => {
    expect(reasonOf("link_lost")).toEqual({ code: "link_lost", params: {} });
    expect(
      reasonOf("bracket_force_out_of_range: bracket front left, force_n 81234.5, limit_n 8e+04"),
    ).toEqual({
      code: "bracket_force_out_of_range",
      params: { bracket: "front left", force_n: 81234.5, limit_n: 80000 },
    });
  });
  it("is its code where the rest is prose", () => {
    expect(reasonOf("bad_parameters: setBracketHeight needs a bracket")).toEqual({
      code: "bad_parameters",
      params: {},
    });
    expect(reasonOf("")).toEqual({ code: "", params: {} });
  });
});

describe("where a person may say that a load is", () => {
  const aircraft = { id: "A-101", mass_kg: 22000 } as Load;
  const jig = { id: "J-1", mass_kg: 500 } as Load;
  const hoist = { number: 1, support: { height_m: 0.02 }, load: undefined };
  const differs = { load: "A-101", load_fault: { code: "load_differs", params: { measured_kg: 0 } } };
  const unknown = (measured_kg: number) => ({
    load_fault: { code: "load_unknown", params: { measured_kg } },
  });
  it("is nothing while all is as known, or something moves", () => {
    expect(placesToSay({ load: "A-101" }, hoist, [])).toEqual([]);
    const lift: Vehicle["lift"] = {
      action_id: "1",
      type: "drop",
      state: "under_way",
      by: "operator",
      at: "2026-11-29T20:00:00Z",
    };
    expect(placesToSay({ ...differs, lift }, hoist, [])).toEqual([]);
  });
  it("is the support here, unless that has another, or nowhere where there is none", () => {
    expect(placesToSay(differs, hoist, [])).toEqual([{ load: "A-101", is: "on_support", station: 1 }]);
    expect(placesToSay(differs, { ...hoist, load: jig }, [])).toEqual([]);
    expect(placesToSay(differs, { number: 2, load: undefined }, [])).toEqual([
      { load: "A-101", is: "not_in_plant" },
    ]);
  });
  it("is the vehicle, of those that weigh what it feels", () => {
    expect(placesToSay(unknown(21500), { ...hoist, load: aircraft }, [jig])).toEqual([
      { load: "A-101", is: "on_vehicle" },
    ]);
    expect(placesToSay(unknown(9000), hoist, [aircraft, jig])).toEqual([]);
    const unweighed = { ...jig, mass_kg: 0 };
    expect(placesToSay(unknown(300), undefined, [unweighed])).toEqual([{ load: "J-1", is: "on_vehicle" }]);
  });
});
