import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import {
  alarmOf,
  haltOf,
  silent,
  stale,
  symbolOf,
  useJobOrder,
  useLink,
  useLive,
  useServerNow,
} from "@/shared/live";
import { StatusSymbol } from "@/shared/ui";
import { age } from "@/shared/words/format";
import { useExpected } from "@/shared/words/useExpected";
import { useWords } from "@/shared/words/useWords";
import { useLasting, useVehicleWords } from "./vehicleWords";

export interface VehicleRowProps {
  vehicle: Vehicle;
  vehicles: ReadonlyMap<string, Vehicle>;
  numberOf: (station: string) => string | undefined;
  selected: boolean;
  two: boolean;
  onSelect: () => void;
}

/** One line of the list: shape, name, what it does, since or until when; and why, where a person is needed. */
export function VehicleRow({ vehicle: v, vehicles, numberOf, selected, two, onSelect }: VehicleRowProps) {
  const { t } = useTranslation("map");
  const words = useWords();
  const now = useServerNow(500);
  const order = useJobOrder(v.order);
  const { doing, why, todo } = useVehicleWords(numberOf, vehicles)(v, order);
  const since = useLive((s) => s.since.get(v.id));
  const lasting = useLasting();
  const { left } = useExpected();
  const link = useLink();
  const lost = link.state.kind === "lost";
  const alarm = alarmOf(v);
  const waits = v.activity === "waiting" || v.activity === "paused" || v.activity === "moving";
  // Who waits for a person because one drives it is told by whose hands it is in.
  const hand = alarm === undefined || alarm.kind === "person" ? words.inHand(v) : undefined;
  const text =
    hand ?? (alarm !== undefined || (waits && why !== "" && haltOf(v) !== "stopping") ? why : doing);
  const silentS = v.last_heard_at === undefined ? undefined : (now - Date.parse(v.last_heard_at)) / 1000;
  const old = lost || stale(v);
  const when = (): string => {
    if (v.link === "never") return "";
    if (old) return age(lost ? link.ageS : silentS);
    if (v.activity === "moving" && haltOf(v) === "none") return left(v.leg?.expected_at) ?? "";
    return alarm !== undefined || v.activity === "waiting" || v.activity === "paused"
      ? lasting(v, since, now)
      : "";
  };
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
      <span className="what">{text}</span>
      <span className="when" title={silent(v) || old ? undefined : t("when")}>
        {when()}
      </span>
      {two && <span className="why">{todo}</span>}
    </button>
  );
}
