import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { useServerNow } from "@/shared/live";
import { haltOf } from "@/shared/live/pause";
import { dateTime } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";

/** Who holds a vehicle, since when, and whether it stands; or what it waits for a person for. */
export function useHeldWords(): (vehicle: Vehicle) => string {
  const { t } = useTranslation("commands");
  const words = useWords();
  const now = useServerNow(60_000);
  return (v) => {
    const why = v.needs_resume_reason && words.reason(v.needs_resume_reason);
    if (!v.paused) return why ?? "";
    const by = v.pause?.by === undefined ? t("held.somebody") : words.actor(v.pause.by);
    const key = v.pause?.with_fleet ? "held.fleet" : "held.singly";
    const who =
      v.pause?.at === undefined ? t(`${key}_plain`, { by }) : t(key, { by, time: dateTime(v.pause.at, now) });
    const halt = haltOf(v);
    const parts = [who, halt === "none" ? "" : t(`held.${halt}`), why ?? ""];
    return parts.filter(Boolean).join(" ");
  };
}
