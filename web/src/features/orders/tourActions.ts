import type { Plant, Station, Vehicle } from "@/shared/api/types";
import { feetDown } from "@/shared/live/feet";
import type { StepAction } from "@/shared/words/actions";
import type { Tour, TourStep } from "./tour";

/** What is asked of a load at a station that can hold one: either of the two, never both. */
export type Transfer = { type: "pick"; load: string } | { type: "drop" };

/** What is known while a tour is written. */
export interface Scene {
  plant: Plant | undefined;
  /** The vehicle that is to drive it; undefined: any that can. */
  vehicle: Vehicle | undefined;
  /** What is on the supports now: ids of loads by ids of stations. */
  there: ReadonlyMap<string, string>;
}

/** What may be done at a station of a tour, and what will be. */
export interface Arrival {
  /** Whether the vehicle stands on its feet; undefined: none that may come has any. */
  feet: boolean | undefined;
  /** Empty: nothing holds a load there. */
  transfers: readonly Transfer[];
  transfer: Transfer | undefined;
}

export const isSame = (a: Transfer, b: Transfer | undefined) => JSON.stringify(a) === JSON.stringify(b);

export function actionOf(transfer: Transfer): StepAction {
  return transfer.type === "pick"
    ? { type: "pick", parameters: { load: transfer.load } }
    : { type: transfer.type };
}

/** Step by step: what hangs at a station by then depends on what the tour has set down and taken over before. */
export function arrivals(tour: Tour, scene: Scene): Arrival[] {
  const there = new Map([...scene.there].map(([station, load]) => [station, [load]]));
  let carried = scene.vehicle?.load;
  return tour.steps.map((step) => {
    const station = scene.plant?.stations.find((s) => s.number === Number(step.station));
    if (step.station === "" || station === undefined)
      return { feet: undefined, transfers: [], transfer: undefined };
    const feet = feetAt(station, step, tour, scene);
    if (station.support === undefined) return { feet, transfers: [], transfer: undefined };
    const { transfer } = step;
    const loads = there.get(station.id) ?? [];
    const transfers: Transfer[] = [
      ...loads.map((load): Transfer => ({ type: "pick", load })),
      { type: "drop" },
    ];
    if (transfer && !transfers.some((one) => isSame(one, transfer))) transfers.unshift(transfer);
    if (transfer?.type === "pick") {
      there.set(
        station.id,
        loads.filter((load) => load !== transfer.load),
      );
      carried = transfer.load;
    } else if (transfer?.type === "drop") {
      if (carried !== undefined) there.set(station.id, [...loads, carried]);
      carried = undefined;
    }
    return { feet, transfers, transfer };
  });
}

/** As a person wants it, else as the station is for, where whoever may come can do that. */
function feetAt(station: Station, step: TourStep, tour: Tour, { plant }: Scene): boolean | undefined {
  const types = (plant?.vehicles ?? [])
    .filter((v) => tour.vehicle === "" || v.id === tour.vehicle)
    .filter((v) => station.vehicle_types.length === 0 || station.vehicle_types.includes(v.type))
    .map((v) => plant?.vehicle_types.find((type) => type.id === v.type));
  if (!types.some((type) => type?.parking)) return undefined;
  return step.feet ?? (station.parks && types.every((type) => type?.parking));
}

/** Around the drives, a step each. `after` is always said: what a person has seen and left is what is done. */
export function stepActions(tour: Tour, scene: Scene): { before?: StepAction[]; after: StepAction[] }[] {
  let onFeet = scene.vehicle !== undefined && feetDown(scene.vehicle.parking_feet);
  return arrivals(tour, scene).map(({ feet, transfer }) => {
    const raises = onFeet;
    onFeet = feet === true;
    return {
      ...(raises && { before: [{ type: "raiseParking" }] }),
      // What is to be set down or taken over needs the vehicle on its wheels.
      after: [...(transfer ? [actionOf(transfer)] : []), ...(onFeet ? [{ type: "lowerParking" }] : [])],
    };
  });
}
