import { useSyncExternalStore } from "react";
import { currentTheme, subscribeTheme, type Theme } from "./setup";

export function useTheme(): Theme {
  return useSyncExternalStore(subscribeTheme, currentTheme);
}
