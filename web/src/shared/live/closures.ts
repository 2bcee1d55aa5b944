import type { Closure } from "@/shared/api/types";
import type { LiveStore } from "./store";

const kRetryMs = 3000;

/**
 * Keeps the store's closures as the server has them: asks when a snapshot or an event says that floor may have
 * changed, and again after a failure. Of answers that overtake each other the newest question's counts. Gives its end.
 */
export function watchClosures(store: LiveStore, ask: () => Promise<readonly Closure[]>): () => void {
  let asked = 0;
  let retry: ReturnType<typeof setTimeout> | undefined;
  const look = (again = false) => {
    const turn = store.state.floorTurn;
    if (turn === 0 || (turn === asked && !again)) return;
    asked = turn;
    clearTimeout(retry);
    ask().then(
      (closures) => {
        if (asked === turn) store.setClosures(closures);
      },
      () => {
        if (asked === turn) retry = setTimeout(() => look(true), kRetryMs);
      },
    );
  };
  const stop = store.subscribe(() => look());
  return () => {
    stop();
    clearTimeout(retry);
    asked = -1;
  };
}
