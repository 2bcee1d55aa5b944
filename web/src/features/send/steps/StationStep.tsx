import { useTranslation } from "react-i18next";
import type { Plant, Reason } from "@/shared/api/types";
import { Icon, NumberPad } from "@/shared/ui";
import { heading, millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { stationOf, type StationEntry } from "./stationEntry";
import "./StationStep.css";

/** "1–7, 31–33": the numbers there are, so that a wrong one can be put right. */
export function numberRanges(numbers: readonly number[]): string {
  const sorted = [...new Set(numbers)].sort((a, b) => a - b);
  const parts: string[] = [];
  for (let i = 0; i < sorted.length;) {
    let end = i;
    while (end + 1 < sorted.length && sorted[end + 1] === (sorted[end] ?? 0) + 1) ++end;
    parts.push(end > i ? `${sorted[i]}\u2013${sorted[end]}` : `${sorted[i]}`);
    i = end + 1;
  }
  return parts.join(", ");
}

export interface StationStepProps {
  digits: string;
  entry: StationEntry;
  plant: Plant | undefined;
  /** Why the server says that no way leads there. */
  unreachable: Reason | undefined;
  picking: boolean;
  onDigits: (digits: string) => void;
  onPick: () => void;
}

export function StationStep(props: StationStepProps) {
  const { digits, picking, onDigits, onPick } = props;
  const { t } = useTranslation("send");
  return (
    <>
      <Display {...props} />
      <NumberPad label={t("station.pad")} digits={digits} onDigits={onDigits} />
      <button type="button" className="btn wide" aria-pressed={picking} onClick={onPick}>
        <Icon name="map" />
        <span>{picking ? t("station.picking") : t("station.pick")}</span>
      </button>
    </>
  );
}

function Display({ digits, entry, plant, unreachable }: StationStepProps) {
  const { t } = useTranslation("send");
  const words = useWords();
  const station = stationOf(entry);
  const range = numberRanges((plant?.stations ?? []).map((s) => s.number));
  const faulty = entry.kind === "unknown" || entry.kind === "wrong_type" || unreachable !== undefined;
  return (
    <div className={`disp ${faulty ? "faulty" : ""}`} role="status">
      <b className={digits.length > 2 ? "long" : ""}>{digits === "" ? "\u2013" : digits}</b>
      <div className="grow">
        <strong>{title()}</strong>
        <span className="cap">
          {unreachable && station ? words.reason(unreachable) : station ? pose(station.pose) : hint()}
        </span>
      </div>
    </div>
  );

  function title(): string {
    const place = station?.name ?? "";
    if (unreachable && station) return t("station.unreachable", { place });
    switch (entry.kind) {
      case "empty":
      case "unknown":
        return t(`station.${entry.kind}`);
      case "occupied":
      case "reserved":
        return t(`station.${entry.kind}`, { place, by: words.vehicle(entry.by) });
      default:
        return t(`station.${entry.kind}`, { place });
    }
  }
  function hint(): string {
    if (!plant) return "";
    return entry.kind === "unknown"
      ? t("station.unknown_hint", { range })
      : t("station.empty_hint", { count: plant.stations.length, range });
  }
  function pose(at: { x_m: number; y_m: number; heading_rad: number }): string {
    return t("station.pose", {
      x: millimetres(at.x_m),
      y: millimetres(at.y_m),
      heading: heading(at.heading_rad, { decimals: 1 }),
    });
  }
}
