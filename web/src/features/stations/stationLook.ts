import type { StationState } from "@/shared/api/types";
import type { SymbolName } from "@/shared/ui";

export type StationLook = "free" | "reserved" | "occupied" | "ready";

/** Ready only when the server says so: a vehicle stands there, measured inside tolerance. */
export function lookOf(state: StationState | undefined): StationLook {
  if (!state) return "free";
  if (state.occupied_by) return state.ready ? "ready" : "occupied";
  return state.reserved_by ? "reserved" : "free";
}

export const lookSymbol: Record<StationLook, SymbolName | undefined> = {
  free: undefined,
  reserved: "s-wait",
  occupied: "s-stand",
  ready: "c-ok",
};

export const looks: readonly StationLook[] = ["ready", "occupied", "reserved", "free"];

/** Who is on its way here, unless that is the one who stands here already. */
export function comingTo(state: StationState | undefined): string | undefined {
  return state?.reserved_by && state.reserved_by !== state.occupied_by ? state.reserved_by : undefined;
}
