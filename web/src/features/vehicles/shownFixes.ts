import type { Vehicle } from "@/shared/api/types";

export type Fix = NonNullable<Vehicle["fixes"]>[number];

/** Of the fixes, newest first, the `most` newest; where the vehicle refused one or believed it against its wheels, the newest
 * of these in any case: that is what a person comes to look for. */
export function shownFixes(fixes: readonly Fix[], most: number): readonly Fix[] {
  const newest = fixes.slice(0, most);
  const isOdd = ({ result }: Fix) => result === "refused" || result === "begun_anew";
  if (newest.some(isOdd)) return newest;
  const odd = fixes.find(isOdd);
  return odd === undefined ? newest : [...newest.slice(0, most - 1), odd];
}
