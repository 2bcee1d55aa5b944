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
  const choice = (
    name: FilterName,
    label: string,
    all: string,
    options: readonly (readonly [string | number, string])[],
  ) => (
    <label className="field">
      <span className="cap">{label}</span>
      <select value={filter[name] ?? ""} onChange={(event) => onFilter(name, event.target.value)}>
        <option value="">{all}</option>
        {options.map(([value, text]) => (
          <option key={value} value={value}>
            {text}
          </option>
        ))}
      </select>
    </label>
  );
  return (
    <>
      {choice(
        "vehicle",
        t("filter.vehicle"),
        t("filter.all_vehicles"),
        (plant?.vehicles ?? []).map((v) => [v.id, v.name]),
      )}
      {choice(
        "station",
        t("filter.station"),
        t("filter.all_stations"),
        stations.map((s) => [s.number, `${s.number}, ${s.name}`]),
      )}
      {choice(
        "result",
        t("col.result"),
        t("filter.all_results"),
        kResults.map((r) => [r, t(r)]),
      )}
    </>
  );
}
