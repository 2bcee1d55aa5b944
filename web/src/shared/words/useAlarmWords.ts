import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { useServerNow } from "@/shared/live";
import type { Alarm } from "@/shared/live/attention";
import { age, fixed, secondsSince } from "./format";
import { faultText } from "./faults";
import { useWords } from "./useWords";

/** An alarm in a sentence, and what to do about it in a second one. */
export function useAlarmWords(): {
  text: (alarm: Alarm, vehicle: Vehicle | undefined) => string;
  todo: (alarm: Alarm) => string;
} {
  const { t } = useTranslation("alarms");
  const words = useWords();
  const now = useServerNow(500);
  const bracket = (name = "") =>
    t(`bracket_name.${name.toLowerCase().replaceAll(" ", "_")}`, { defaultValue: name });
  return {
    todo: (alarm) => t(`todo.${alarm.kind}`),
    text: (alarm, vehicle) => {
      if (alarm.reason !== undefined) return words.reason(alarm.reason);
      const more = (alarm.share ?? 0) > 0;
      return t(alarm.kind === "bracket" ? (more ? "bracket_over" : "bracket_under") : alarm.kind, {
        fault: alarm.fault === undefined ? "" : faultText(alarm.fault, t),
        wheel: words.wheel(alarm.wheel ?? ""),
        bracket: bracket(alarm.bracket),
        percent: fixed(Math.abs(alarm.share ?? 0) * 100, 0),
        limit: fixed((vehicle?.worst_bracket?.limit ?? 0) * 100, 0),
        temperature: fixed(alarm.temperature_c, 0),
        count: alarm.count,
        age: age(secondsSince(vehicle?.last_heard_at, now)),
      });
    },
  };
}
