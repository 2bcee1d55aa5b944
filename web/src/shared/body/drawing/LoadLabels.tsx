import { useTranslation } from "react-i18next";
import { kilonewtons, mass, millimetres } from "@/shared/words/format";
import { onSheet, type OnSheetProps } from "./faceplate";
import { summarise } from "./loads";

/** Weight and centre of the load. */
export function LoadLabels({ vehicle, type, sheet }: OnSheetProps) {
  const { t } = useTranslation("body");
  const summary = summarise(vehicle, type);
  const centre = vehicle.load_centre;
  if (type?.brackets.length === 0) return null;
  if (!summary) {
    return (
      <span className="wl in" style={{ left: "50%", top: "38%" }}>
        {t("loads.none")}
      </span>
    );
  }
  return (
    <>
      <span className="wl in" style={onSheet(sheet, { x_m: 0, y_m: sheet.halfWidth * 0.68 })}>
        <b>{kilonewtons(summary.total_n)} kN</b> {mass(summary.total_n / 9.80665)}
      </span>
      {centre && (
        <span
          className="wl in centre"
          style={onSheet(sheet, { x_m: centre.x_m, y_m: -sheet.halfWidth * 0.5 })}
        >
          {t(`loads.centre_${centre.x_m < 0 ? "aft" : "fore"}_${centre.y_m >= 0 ? "left" : "right"}`, {
            aft: millimetres(Math.abs(centre.x_m)),
            left: millimetres(Math.abs(centre.y_m)),
          })}
        </span>
      )}
    </>
  );
}
