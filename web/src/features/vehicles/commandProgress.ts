import type { CommandProgress } from "@/shared/ui";
import type { Asked } from "@/shared/ui/useCommand";

/** What the button shows: requested, then stored until the vehicle itself reports what was asked for. */
export function progressOf(asked: Asked, waitingFor: string): CommandProgress {
  switch (asked.kind) {
    case "requested":
      return { kind: "requested", atMs: asked.atMs };
    case "stored":
      return { kind: "accepted", waitingFor };
    default:
      return { kind: "ready" };
  }
}
