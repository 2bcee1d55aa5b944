import type { Vehicle, VehicleType } from "@/shared/api/types";

/** What the largest card of Send shows: the way there, or what the vehicle itself says of its body. */
export const kViews = ["way", "platform", "cameras", "lifts"] as const;
export type View = (typeof kViews)[number];

/** Those that a vehicle has something to show for. */
export function viewsOf(vehicle: Vehicle | undefined, type: VehicleType | undefined): View[] {
  if (vehicle === undefined) return ["way"];
  const lifts = (type?.brackets.length ?? 0) > 0 || vehicle.parking_feet.length > 0;
  const cameras = (type?.cameras.length ?? 0) > 0 || vehicle.cameras.length > 0;
  return kViews.filter((view) => (view !== "lifts" || lifts) && (view !== "cameras" || cameras));
}

export function viewNamed(name: string | null, views: readonly View[]): View {
  return views.find((view) => view === name) ?? "way";
}
