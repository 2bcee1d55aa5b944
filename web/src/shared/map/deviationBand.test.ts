import { expect, it } from "vitest";
import { deviationBand } from "./deviationBand";
import type { DrawnVehicle } from "./scene";

const at = (x_m: number, y_m: number) => ({ x_m, y_m });
// Ahead longer than behind, so that a mirrored band would show.
const type = { footprint: [at(-1, -1), at(3, -1), at(3, 2), at(-1, 2)] } as DrawnVehicle["type"];
const band = (vehicle: Partial<DrawnVehicle["vehicle"]>, k: number) =>
  deviationBand({ vehicle: vehicle as DrawnVehicle["vehicle"], type }, k);

it("lies around the whole body, as wide as the vehicle holds itself to be off", () => {
  expect(band({ pose_known: true, pose_deviation_m: 0.2 }, 100)).toEqual({
    x: -120,
    y: -220,
    width: 440,
    height: 340,
    radius: 20,
  });
});

it("is not drawn where it could not be seen", () => {
  expect(band({ pose_known: true, pose_deviation_m: 0.01 }, 100)).toBeUndefined();
  expect(band({ pose_known: true, pose_deviation_m: 0.01 }, 300)?.radius).toBe(3);
});

it("is not drawn for a vehicle that does not say, nor for one that is lost", () => {
  expect(band({ pose_known: true }, 100)).toBeUndefined();
  expect(band({ pose_known: false, pose_deviation_m: 0.2 }, 100)).toBeUndefined();
});
