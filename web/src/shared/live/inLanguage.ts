import type { Plant } from "../api/types";

interface Named {
  name: string;
  names?: Readonly<Record<string, string>>;
}

/** A thing by its name in a language, where it has one in it; else as it is called. */
export function namedIn<T extends Named>(thing: T, language: string): T {
  const name = thing.names?.[language];
  return name === undefined ? thing : { ...thing, name };
}

/** The plant with every name in a language, where the plant has one in it; else as the plant says it. */
export function inLanguage(plant: Plant, language: string): Plant {
  const named = <T extends Named>(thing: T): T => namedIn(thing, language);
  return {
    ...named(plant),
    halls: plant.halls.map(named),
    stations: plant.stations.map(named),
    areas: plant.areas.map(named),
    vehicle_types: plant.vehicle_types.map(named),
  };
}
