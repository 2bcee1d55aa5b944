import { useTranslation } from "react-i18next";
import { usePlant } from "@/shared/live";
import type { StopFilter } from "./stopLists";
import "./RecordFilters.css";

/** Which stops are listed: of a vehicle, at a station. */
export function RecordFilters({
  filter,
  onFilter,
}: {
  filter: StopFilter;
  /** An empty value is no filter. */
  onFilter: (name: "vehicle" | "station", value: string) => void;
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
    </>
  );
}
