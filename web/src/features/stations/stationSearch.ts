import type { Plant, Station } from "@/shared/api/types";
import { inside } from "@/shared/math/geometry";

/** The zone of the plant in which a station lies; names are as the plant given says them. */
export function zoneOf(station: Pick<Station, "hall" | "pose">, areas: Plant["areas"]): string {
  const at = { x: station.pose.x_m, y: station.pose.y_m };
  const zone = areas.find(
    (area) =>
      area.kind === "zone" &&
      area.hall === station.hall &&
      inside(
        area.outline.map((p) => ({ x: p.x_m, y: p.y_m })),
        at,
      ),
  );
  return zone?.name ?? "";
}

/** Stations of this number, or whose name or zone holds what is asked for. */
export function foundStations<T extends { number: number; name: string; zone: string }>(
  stations: readonly T[],
  find: string,
): T[] {
  const wanted = find.trim().toLowerCase();
  if (wanted === "") return [...stations];
  if (/^\d+$/.test(wanted)) return stations.filter((s) => String(s.number) === wanted);
  return stations.filter((s) => [s.name, s.zone].some((text) => text.toLowerCase().includes(wanted)));
}
