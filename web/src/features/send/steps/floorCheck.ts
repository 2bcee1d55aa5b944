import type { Check, Closure, ModeOption } from "@/shared/api/types";

/** The server's checks, and one that the screen makes of closed floor. */
export type ShownCheck = Omit<Check, "code"> & { code: Check["code"] | "floor" };

/** Closed floor on the only way there: the order would wait until a person reopens it, so it is not begun. */
export function floorCheck(
  option: ModeOption | undefined,
  closures: readonly Closure[],
): ShownCheck | undefined {
  if (option?.feasible !== true) return undefined;
  const bars = option.closures ?? [];
  if (bars.length === 0) return { code: "floor", result: "pass", params: { closed: closures.length } };
  const known = closures.filter((c) => bars.includes(c.id));
  const by = [...new Set(known.map((c) => c.created_by))].join(", ");
  const names = known.map((c) => c.name).join(", ");
  return { code: "floor", result: "fail", params: names === "" ? {} : { closure: names, by } };
}
