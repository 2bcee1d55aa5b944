import type { Check, Closure, Load, ModeOption, Vehicle } from "@/shared/api/types";

/** The server's checks, and those that the screen makes of the chosen way. */
export type ShownCheck = Omit<Check, "code"> & { code: Check["code"] | "floor" | "codes_on_way" };

/**
 * Closed floor on the only way there, or a load that would be run into: the order would wait until a person
 * reopens it or has that moved, so it is not begun.
 */
export function floorCheck(
  option: ModeOption | undefined,
  closures: readonly Closure[],
  loads: readonly Load[],
): ShownCheck | undefined {
  if (option?.feasible !== true) return undefined;
  const standing = option.loads_in_the_way ?? [];
  if (standing.length > 0) {
    const names = standing.map((id) => loads.find((load) => load.id === id)?.name ?? id);
    return { code: "floor", result: "fail", params: { load: names.join(", ") } };
  }
  const bars = option.closures ?? [];
  if (bars.length === 0) return { code: "floor", result: "pass", params: { closed: closures.length } };
  const known = closures.filter((c) => bars.includes(c.id));
  const by = [...new Set(known.map((c) => c.created_by))].join(", ");
  const names = known.map((c) => c.name).join(", ");
  return { code: "floor", result: "fail", params: names === "" ? {} : { closure: names, by } };
}

/** Farther without a code than it may drive to catch the next one, or to know its place: said, not refused. */
export function codesCheck(option: ModeOption | undefined): ShownCheck | undefined {
  if (option?.feasible !== true) return undefined;
  const note = (params: ShownCheck["params"]): ShownCheck => ({
    code: "codes_on_way",
    result: "note",
    params,
  });
  const missing = option.marker_chain?.reason?.params;
  if (missing !== undefined) {
    const { gap_m, ...rest } = missing;
    return note(gap_m === undefined ? rest : { widest_gap_m: gap_m, ...rest });
  }
  const gap = option.codes_on_way;
  if (gap === undefined || gap.widest_gap_m <= gap.at_most_m) return undefined;
  return note({ widest_gap_m: gap.widest_gap_m, at_most_m: gap.at_most_m });
}

/** Whatever else bars it: while a person drives it by hand, that person has to give it back first. */
export function withHands(
  checks: readonly ShownCheck[],
  vehicle: Pick<Vehicle, "in_hand_of"> | undefined,
): ShownCheck[] {
  const person = vehicle?.in_hand_of;
  return checks.map((check) =>
    person === undefined || check.code !== "mode" || check.result === "pass"
      ? check
      : { ...check, params: { ...check.params, reason: "driven_by_hand", person } },
  );
}
