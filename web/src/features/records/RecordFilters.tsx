import { useTranslation } from "react-i18next";
import { usePlant } from "@/shared/live";
import { kResults, type StopFilter } from "./stopLists";
import "./RecordFilters.css";

export type FilterName = "vehicle" | "station" | "result";

/** Which stops are listed: of a vehicle, at a station, that came out in some way. */
export function RecordFilters({
  filter,
  onFilter,
}: {
  filter: StopFilter & { result: (typeof kResults)[number] | undefined };
  /** An empty value is no filter. */
  onFilter: (name: FilterName, value: string) => void;
}) {
  const { t } = useTranslation("records");
  const plant = usePlant().data;
  const stations = [...(plant?.stations ?? [])].sort((a, b) => a.number - b.number);
  return (
    <>
      <label className="field">
        <span className="cap">{t("filter.vehicle")}</span>
        <select value={filter.vehicle ?? ""} onChange={(event) => onFilter("vehicle", event.target.value)}>
          <option value="">{t("filter.all_vehicles")}</option>
          {plant?.vehicles.map((v) => (
            <option key={v.id} value={v.id}>
              {v.name}
            </option>
          ))}
        </select>
      </label>
      <label className="field">
        <span className="cap">{t("filter.station")}</span>
        <select value={filter.station ?? ""} onChange={(event) => onFilter("station", event.target.value)}>
          <option value="">{t("filter.all_stations")}</option>
          {stations.map((s) => (
            <option key={s.id} value={s.number}>
              {s.number}, {s.name}
            </option>
          ))}
        </select>
      </label>
      <label className="field">
        <span className="cap">{t("col.result")}</span>
        <select value={filter.result ?? ""} onChange={(event) => onFilter("result", event.target.value)}>
          <option value="">{t("filter.all_results")}</option>
          {kResults.map((result) => (
            <option key={result} value={result}>
              {t(result)}
            </option>
          ))}
        </select>
      </label>
    </>
  );
}
