import { useSyncExternalStore } from "react";

const subscribe = (listener: () => void) => {
  document.addEventListener("visibilitychange", listener);
  return () => document.removeEventListener("visibilitychange", listener);
};

/** False while the page is in a tab that nobody sees. */
export function useOnScreen(): boolean {
  return useSyncExternalStore(subscribe, () => document.visibilityState === "visible");
}
