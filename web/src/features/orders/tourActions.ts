import type { Plant, Station, Vehicle } from "@/shared/api/types";
import { bracketsWanted, liftOf, type BracketLift, type BracketsDraft } from "@/shared/body/bracketStep";
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
  /** Brackets of whoever may come; undefined: none has any. */
  lift: BracketLift | undefined;
  brackets: BracketsDraft | undefined;
  /** What they do, where it can be. */
  raises: StepAction | undefined;
}

const kNothing: Arrival = {
  feet: undefined,
  transfers: [],
  transfer: undefined,
  lift: undefined,
  brackets: undefined,
  raises: undefined,
};

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
    if (step.station === "" || station === undefined) return kNothing;
    const feet = feetAt(station, step, tour, scene);
    const lift = liftAt(station, tour.vehicle, scene.plant);
    const { brackets } = step;
    const rest = { ...kNothing, feet, lift, brackets, raises: bracketsWanted(brackets, lift).action };
    if (station.support === undefined) return rest;
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
    return { ...rest, transfers, transfer };
  });
}

/** Types of those that may come to the station; `vehicle`: the one that drives the tour, empty: any that can. */
function typesAt(station: Station, vehicle: string, plant: Plant | undefined) {
  return (plant?.vehicles ?? [])
    .filter((v) => vehicle === "" || v.id === vehicle)
    .filter((v) => station.vehicle_types.length === 0 || station.vehicle_types.includes(v.type))
    .map((v) => plant?.vehicle_types.find((type) => type.id === v.type));
}

export const liftAt = (
  station: Station,
  vehicle: string,
  plant: Plant | undefined,
): BracketLift | undefined => liftOf(typesAt(station, vehicle, plant));

/** As a person wants it, else as the station is for, where whoever may come can do that. */
function feetAt(station: Station, step: TourStep, tour: Tour, { plant }: Scene): boolean | undefined {
  const types = typesAt(station, tour.vehicle, plant);
  if (!types.some((type) => type?.parking)) return undefined;
  return step.feet ?? (station.parks && types.every((type) => type?.parking));
}

/** Around the drives, a step each. `after` is always said: what a person has seen and left is what is done. */
export function stepActions(tour: Tour, scene: Scene): { before?: StepAction[]; after: StepAction[] }[] {
  let onFeet = scene.vehicle !== undefined && feetDown(scene.vehicle.parking_feet);
  return arrivals(tour, scene).map(({ feet, transfer, raises: brackets }) => {
    const raises = onFeet;
    onFeet = feet === true;
    return {
      ...(raises && { before: [{ type: "raiseParking" }] }),
      // What is to be set down needs brackets that are high enough; that or a take-over needs the vehicle on its wheels.
      after: [
        ...(brackets ? [brackets] : []),
        ...(transfer ? [actionOf(transfer)] : []),
        ...(onFeet ? [{ type: "lowerParking" }] : []),
      ],
    };
  });
}
