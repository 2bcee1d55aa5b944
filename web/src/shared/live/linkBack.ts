import type { LiveStore } from "./store";

/** Calls `then` each time the link is live again after it was lost. Gives its end. */
export function whenLinkIsBack(store: LiveStore, then: () => void): () => void {
  let lost = store.state.link.kind === "lost";
  return store.subscribe(() => {
    const { kind } = store.state.link;
    if (kind === "lost") lost = true;
    if (kind !== "live" || !lost) return;
    lost = false;
    then();
  });
}
