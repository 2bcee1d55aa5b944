import { useTranslation } from "react-i18next";
import type { MotionMode, StepPreview } from "@/shared/api/types";
import { Icon } from "@/shared/ui";
import { duration } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { TourArrival, useArrivalWords } from "./TourArrival";
import { chosenOf, type TourEvent, type TourFault, type TourStep } from "./tour";
import type { Arrival } from "./tourActions";
import "./TourRow.css";

export interface TourRowProps {
  step: TourStep;
  index: number;
  last: boolean;
  only: boolean;
  active: boolean;
  place: string;
  fault: TourFault | undefined;
  preview: StepPreview | undefined;
  arrival: Arrival | undefined;
  onActive: () => void;
  dispatch: (event: TourEvent) => void;
}

/** One station of a tour: its number, how, how long and what for, or what is wrong. The active one takes the pad's digits. */
export function TourRow(props: TourRowProps) {
  const { step, index, last, only, active, place, fault, preview, arrival, onActive, dispatch } = props;
  const { t } = useTranslation("orders");
  const words = useWords();
  const does = useArrivalWords();
  const then = arrival && does(arrival);
  const option = preview && chosenOf(preview, step.mode);
  const wrong = fault !== undefined && fault.kind !== "missing";
  const modes: MotionMode[] = [
    "auto",
    ...(preview?.options.filter((o) => o.feasible).map((o) => o.mode) ?? []),
  ];
  if (!modes.includes(step.mode)) modes.push(step.mode);
  return (
    <li className={active ? "active" : ""}>
      <button
        type="button"
        className={`num ${wrong ? "bad" : ""}`}
        aria-pressed={active}
        aria-label={t("tour.station", { index })}
        onClick={onActive}
      >
        <small>{index}</small>
        <b>{step.station === "" ? "\u2013" : step.station}</b>
      </button>
      <span className={wrong || option?.feasible === false ? "lab bad" : "lab"}>{says()}</span>
      <button
        type="button"
        className="btn icon up"
        aria-label={t("tour.up", { index })}
        disabled={index === 1}
        onClick={() => dispatch({ kind: "move", id: step.id, by: -1 })}
      >
        <Icon name="chev" />
      </button>
      <button
        type="button"
        className="btn icon"
        aria-label={t("tour.down", { index })}
        disabled={last}
        onClick={() => dispatch({ kind: "move", id: step.id, by: 1 })}
      >
        <Icon name="chev" />
      </button>
      <button
        type="button"
        className="btn icon"
        aria-label={t("tour.remove", { index })}
        disabled={only}
        onClick={() => dispatch({ kind: "remove", id: step.id })}
      >
        <Icon name="x" />
      </button>
      {then !== undefined && <span className="then">{then}</span>}
      {active && modes.length > 1 && (
        <div className="modes" role="group" aria-label={t("tour.mode", { index })}>
          {modes.map((mode) => (
            <button
              key={mode}
              type="button"
              className="btn"
              aria-pressed={mode === step.mode}
              onClick={() => dispatch({ kind: "mode", id: step.id, mode })}
            >
              {words.modeShort(mode)}
            </button>
          ))}
        </div>
      )}
      {active && arrival && <TourArrival id={step.id} index={index} arrival={arrival} dispatch={dispatch} />}
    </li>
  );

  function says(): string {
    if (wrong) return t(`tour.${fault.kind}`, { station: "station" in fault ? fault.station : "" });
    if (option?.feasible === false && option.reason) return words.reason(option.reason);
    if (option?.duration_s !== undefined)
      return [place, words.modeShort(option.mode), duration(option.duration_s)].join(t("join"));
    return place;
  }
}
