import { describe, expect, it } from "vitest";
import type { Load, Station, StationState, Vehicle } from "@/shared/api/types";
import { transferAction, transferAt } from "./transfer";

const station = { id: "s1", number: 1, support: { height_m: 0.02 } } as Station;
const platform = (load?: string, type = "platform") =>
  ({ id: "TP-01", type, load, brackets: [{ name: "front left" }] }) as unknown as Vehicle;
const holds = (load?: string) => [{ station: "s1", load }] as unknown as StationState[];
const loads = [{ id: "A-101", carriers: ["platform"] }] as Load[];
const told = (...at: Parameters<typeof transferAt>) => {
  const found = transferAt(...at);
  return found && `${found.type} ${found.load}`;
};

describe("a load at the station that a vehicle is sent to", () => {
  it.each([
    ["taken over by an empty vehicle", platform(), holds("A-101"), "pick A-101"],
    ["set down where nothing is", platform("A-102"), holds(), "drop A-102"],
    ["nothing where both have one", platform("A-102"), holds("A-101"), undefined],
    ["nothing where none has one", platform(), holds(), undefined],
    ["nothing for who may not carry it", platform(undefined, "mover"), holds("A-101"), undefined],
    ["nothing before a vehicle is chosen", undefined, holds("A-101"), undefined],
  ])("is %s", (_, vehicle, states, is) => expect(told(station, states, vehicle, loads)).toBe(is));
  it("is nothing without a support, nor without brackets", () => {
    expect(
      told({ ...station, support: undefined } as unknown as Station, holds("A-101"), platform(), loads),
    ).toBe(undefined);
    expect(told(station, holds("A-101"), { ...platform(), brackets: [] }, loads)).toBe(undefined);
  });
  it("is chosen for this load and this station only", () => {
    const of = (vehicle: Vehicle, states: StationState[]) => transferAt(station, states, vehicle, loads)?.key;
    expect(of(platform(), holds("A-101"))).not.toBe(of(platform("A-101"), holds()));
    expect(of(platform(), holds("A-101"))).not.toBe(of(platform(), holds("A-109")));
  });
  it("names the load only where it is taken over", () => {
    expect(transferAction({ type: "pick", load: "A-101", key: "" })).toEqual({
      type: "pick",
      parameters: { load: "A-101" },
    });
    expect(transferAction({ type: "drop", load: "A-101", key: "" })).toEqual({ type: "drop" });
  });
});
