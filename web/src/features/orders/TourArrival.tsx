import { useTranslation } from "react-i18next";
import { BracketFields } from "@/shared/body/BracketFields";
import { emptyBrackets } from "@/shared/body/bracketStep";
import { usePlant } from "@/shared/live";
import { useWords } from "@/shared/words/useWords";
import type { TourEvent } from "./tour";
import { actionOf, isSame, type Arrival } from "./tourActions";

export interface TourArrivalProps {
  id: number;
  index: number;
  arrival: Arrival;
  dispatch: (event: TourEvent) => void;
}

/** What the vehicle does when it has arrived: takes a load over or sets its own down, and stands on its feet. */
export function TourArrival({ id, index, arrival, dispatch }: TourArrivalProps) {
  const { t } = useTranslation("orders");
  const words = useWords();
  const { feet, transfers, transfer, lift, brackets } = arrival;
  const types = usePlant().data?.vehicle_types ?? [];
  if (feet === undefined && transfers.length === 0 && lift === undefined) return null;
  return (
    <div className="modes" role="group" aria-label={t("tour.arrival", { index })}>
      {transfers.map((one) => {
        const label = words.action(actionOf(one));
        const pressed = isSame(one, transfer);
        return (
          <button
            key={label}
            type="button"
            className="btn"
            aria-pressed={pressed}
            onClick={() => dispatch({ kind: "transfer", id, transfer: pressed ? undefined : one })}
          >
            {label}
          </button>
        );
      })}
      {feet !== undefined && (
        <button
          type="button"
          className="btn"
          aria-pressed={feet}
          onClick={() => dispatch({ kind: "feet", id, feet: !feet })}
        >
          {t("tour.feet")}
        </button>
      )}
      {lift && (
        <button
          type="button"
          className="btn"
          aria-pressed={brackets !== undefined}
          onClick={() =>
            dispatch({ kind: "brackets", id, brackets: brackets === undefined ? emptyBrackets() : undefined })
          }
        >
          {t("tour.brackets")}
        </button>
      )}
      {lift && brackets && (
        <BracketFields
          draft={brackets}
          lift={lift}
          type={types.find((type) => type.brackets.some(({ name }) => lift.names.includes(name)))}
          onChange={(next) => dispatch({ kind: "brackets", id, brackets: next })}
        />
      )}
    </div>
  );
}

/** What of this is chosen, in the order in which it is done; undefined: nothing. */
export function useArrivalWords(): (arrival: Arrival) => string | undefined {
  const { t } = useTranslation("orders");
  const words = useWords();
  return ({ feet, transfer, raises }) => {
    const does = [
      ...(raises ? [words.action(raises)] : []),
      ...(transfer ? [words.action(actionOf(transfer))] : []),
      ...(feet === true ? [t("tour.feet")] : []),
    ];
    return does.length === 0 ? undefined : does.join(t("join"));
  };
}
