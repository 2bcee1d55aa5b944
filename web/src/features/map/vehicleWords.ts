import { useTranslation } from "react-i18next";
import type { JobOrder, Vehicle } from "@/shared/api/types";
import { useHeldWords } from "@/shared/commands";
import { alarmOf, eachOther, haltOf, silent, type Since, sinceOf } from "@/shared/live";
import { age, fixed, timeOfDay } from "@/shared/words/format";
import { useAlarmWords } from "@/shared/words/useAlarmWords";
import { useWords } from "@/shared/words/useWords";
import { whatOf } from "./listRows";

export interface VehicleWords {
  /** What it does, with its load. */
  doing: string;
  /** What is wrong with it; else why it stands or waits; else empty. */
  why: string;
  /** What to do about what is wrong, or where a silent one was last seen. */
  todo: string;
}

/** A vehicle in words, the same in its row and on its card. */
export function useVehicleWords(
  numberOf: (station: string) => string | undefined,
  vehicles: ReadonlyMap<string, Vehicle>,
): (v: Vehicle, order: JobOrder | undefined) => VehicleWords {
  const { t } = useTranslation("map");
  const words = useWords();
  const alarmWords = useAlarmWords();
  const held = useHeldWords();
  return (v, order) => {
    const what = whatOf(v, numberOf, order);
    const plain = t(`what.${what.key}`, what.values);
    const doing =
      v.load_name === ""
        ? plain.charAt(0).toUpperCase() + plain.slice(1)
        : t("what.with", { load: v.load_name, what: plain });
    const alarm = alarmOf(v);
    if (alarm !== undefined) {
      const seen = silent(v) ? v.pose : undefined;
      const todo =
        seen === undefined
          ? alarmWords.todo(alarm)
          : t("seen", { x: fixed(seen.x_m, 1), y: fixed(seen.y_m, 1), time: timeOfDay(v.last_heard_at) });
      return { doing, why: alarmWords.text(alarm, v), todo };
    }
    const other = eachOther(v, vehicles);
    const why =
      other !== undefined
        ? t("what.each_other", { name: words.vehicle(other) })
        : v.paused && haltOf(v) !== "stopping"
          ? held(v)
          : v.reason === undefined || v.link === "never"
            ? ""
            : words.reason(v.reason);
    return { doing, why, todo: "" };
  };
}

/** How long it has been so; what began before this page was opened has lasted longer than that. */
export function useLasting(): (v: Vehicle, known: Since | undefined, nowMs: number) => string {
  const { t } = useTranslation("map");
  return (v, known, nowMs) => {
    const since = sinceOf(v, known);
    if (since === undefined) return "";
    const text = age(Math.max(0, nowMs - since.atMs) / 1000);
    return since.exact ? text : t("longer", { age: text });
  };
}
