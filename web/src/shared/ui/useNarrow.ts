import { useSyncExternalStore } from "react";

const media = (query: string) => (typeof window === "undefined" ? undefined : window.matchMedia(query));
const desk = media("(max-width: 1599px)");
const tablet = media("(max-width: 1535px)");
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

/** True on laptops, tablets and phones, where one thing is shown at a time. */
export const useNarrow = (): boolean => useMatches(tablet);

/** True where no third column fits. */
export const useTight = (): boolean => useMatches(desk);

/** True on phones, where all stands in one column. */
export const usePhone = (): boolean => useMatches(phone);
