import { useTranslation } from "react-i18next";
import { useVehicles } from "@/shared/live";
import { useWords } from "@/shared/words/useWords";
import type { Tour, TourEvent } from "./tour";

/** Who drives a tour, and how urgent it is. */
export function TourFields({ state, dispatch }: { state: Tour; dispatch: (event: TourEvent) => void }) {
  const { t } = useTranslation("orders");
  const words = useWords();
  const vehicles = useVehicles();
  return (
    <div className="fields">
      <div className="tourwho" role="group" aria-label={t("tour.vehicle")}>
        {["", ...vehicles.map((v) => v.id)].map((id) => (
          <button
            key={id}
            type="button"
            className="btn"
            aria-pressed={state.vehicle === id}
            onClick={() => dispatch({ kind: "vehicle", vehicle: id })}
          >
            {id === "" ? t("tour.any") : words.vehicle(id)}
          </button>
        ))}
      </div>
      <label className="field">
        <span className="cap">{t("tour.priority")}</span>
        <input
          type="number"
          min={-100}
          max={100}
          value={state.priority}
          onChange={(e) => dispatch({ kind: "priority", priority: Number(e.target.value) || 0 })}
        />
      </label>
    </div>
  );
}
