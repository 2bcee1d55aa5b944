import { useSyncExternalStore } from "react";

const media = (query: string) => (typeof window === "undefined" ? undefined : window.matchMedia(query));
const tablet = media("(max-width: 1279px)");
const phone = media("(max-width: 719px)");

function useMatches(query: MediaQueryList | undefined): boolean {
  return useSyncExternalStore(
    (listener) => {
      query?.addEventListener("change", listener);
      return () => query?.removeEventListener("change", listener);
    },
    () => query?.matches ?? false,
  );
}

/** True on tablets and phones, where one thing is shown at a time. */
export const useNarrow = (): boolean => useMatches(tablet);

/** True on phones, where all stands in one column. */
export const usePhone = (): boolean => useMatches(phone);
