import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { age, fixed, timeOfDay } from "@/shared/i18n/format";
import { alarmOf, haltOf, silent, stale, symbolOf, useJobOrder, useLink, useServerNow } from "@/shared/live";
import { StatusSymbol } from "@/shared/ui";
import { useAlarmWords } from "@/shared/words/useAlarmWords";
import { useExpected } from "@/shared/words/useExpected";
import { useWords } from "@/shared/words/useWords";
import { whatOf } from "./listRows";

export interface VehicleRowProps {
  vehicle: Vehicle;
  numberOf: (station: string) => string | undefined;
  selected: boolean;
  two: boolean;
  onSelect: () => void;
}

/** One line of the list: shape, name, what it does, since or until when; and why, where a person is needed. */
export function VehicleRow({ vehicle: v, numberOf, selected, two, onSelect }: VehicleRowProps) {
  const { t } = useTranslation("map");
  const words = useWords();
  const now = useServerNow(500);
  const order = useJobOrder(v.order);
  const what = whatOf(v, numberOf, order);
  const plain = t(`what.${what.key}`, what.values);
  const text =
    v.load_name !== "" && !two
      ? t("what.with", { load: v.load_name, what: plain })
      : plain.charAt(0).toUpperCase() + plain.slice(1);
  const silentS = v.last_heard_at === undefined ? undefined : (now - Date.parse(v.last_heard_at)) / 1000;
  const { left } = useExpected();
  const link = useLink();
  const lost = link.state.kind === "lost";
  const alarm = alarmOf(v);
  const alarmWords = useAlarmWords();
  const seen = silent(v) && v.pose !== undefined;
  const why =
    alarm !== undefined
      ? seen
        ? t("seen", { x: fixed(v.pose!.x_m, 1), y: fixed(v.pose!.y_m, 1), time: timeOfDay(v.last_heard_at) })
        : alarmWords.todo(alarm)
      : v.reason === undefined
        ? ""
        : words.reason(v.reason);
  const head = alarm === undefined ? text : alarmWords.text(alarm, v);
  const saysWhy = ["waiting", "paused", "moving"].includes(v.activity) && haltOf(v) !== "stopping";
  const old = lost || stale(v);
  return (
    <button
      type="button"
      className={`veh ${selected ? "sel" : ""} ${two ? "two" : ""} ${old ? "old" : ""}`}
      aria-pressed={selected}
      data-vehicle={v.id}
      data-alarm={alarm?.priority ?? "none"}
      onClick={onSelect}
    >
      <StatusSymbol name={lost ? "s-stale" : symbolOf(v)} />
      <span className="id">{v.name}</span>
      <span className="what">{!two && saysWhy && why !== "" ? why : head}</span>
      <span className="when">
        {old
          ? age(lost ? link.ageS : silentS)
          : v.activity === "moving" && haltOf(v) === "none"
            ? left(v.leg?.expected_at)
            : ""}
      </span>
      {two && <span className="why">{why}</span>}
    </button>
  );
}
