import { useTranslation } from "react-i18next";
import { useServerNow } from "@/shared/live";
import { expectedIn } from "./expected";
import { duration, timeOfDay } from "./format";

/** Expected times in words: as a time of day, or as the time that is left; late says by how much. */
export function useExpected(): {
  clock: (at: string | undefined) => string | undefined;
  left: (at: string | undefined) => string | undefined;
} {
  const { t } = useTranslation("words");
  const now = useServerNow(500);
  const say = (at: string | undefined, ahead: (s: number) => string) => {
    const when = expectedIn(at, now);
    if (when.kind === "none") return undefined;
    return when.kind === "in" ? ahead(when.s) : t("late", { by: duration(when.s) });
  };
  return { clock: (at) => say(at, () => timeOfDay(at)), left: (at) => say(at, duration) };
}
