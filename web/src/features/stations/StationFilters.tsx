import { useTranslation } from "react-i18next";
import { SearchField } from "@/shared/ui";
import { looks, type StationLook } from "./stationLook";
import "./StationFilters.css";

export interface StationFiltersProps {
  find: string;
  onFind: (text: string) => void;
  /** Undefined: all. */
  look: StationLook | undefined;
  onLook: (look: StationLook | undefined) => void;
  count: (look: StationLook | undefined) => number;
  /** Numbers of the stations that are shown. */
  shown: number[];
}

/** Which stations are shown, and the sheets of their codes. */
export function StationFilters({ find, onFind, look, onLook, count, shown }: StationFiltersProps) {
  const { t } = useTranslation("stations");
  return (
    <div className="sfilter">
      <SearchField label={t("find")} text={find} onText={onFind} />
      <div className="seg" role="group" aria-label={t("filter")}>
        {[undefined, ...looks].map((one) => (
          <button key={one ?? "all"} type="button" aria-pressed={look === one} onClick={() => onLook(one)}>
            {t(one === undefined ? "filter_all" : `state.${one}`)} {count(one)}
          </button>
        ))}
      </div>
      {shown.length > 0 && <PrintCodes stations={shown} />}
    </div>
  );
}

/** True-scale sheets of the floor codes of the stations shown, to print, cut and lay. */
function PrintCodes({ stations }: { stations: number[] }) {
  const { t } = useTranslation("stations");
  return (
    <div className="row print" role="group" aria-label={t("print")}>
      <span>{t("print")}</span>
      {(["pdf", "svg", "csv"] as const).map((format) => (
        <a
          key={format}
          className="btn"
          href={`/api/v1/marker-sheets?stations=${stations.join(",")}&format=${format}`}
          download
        >
          {t(`print_${format}`)}
        </a>
      ))}
    </div>
  );
}
