import { useTranslation } from "react-i18next";
import { kilonewtons, millimetres } from "@/shared/words/format";
import { bracketKey, onSheet, type OnSheetProps } from "./faceplate";
import { summarise, type SensorShare } from "./loads";

/** A card a bracket: how high it is, and the forces of its two pins. */
export function ForceCards({ vehicle, type, sheet }: OnSheetProps) {
  const { t } = useTranslation("body");
  const summary = summarise(vehicle, type);
  if (!summary) return null;
  return (
    <>
      {summary.brackets.map((b) => {
        const at = type?.brackets.find((x) => x.name === b.name)?.position;
        if (!at) return null;
        const up = at.y_m >= 0;
        const place = onSheet(sheet, { x_m: at.x_m, y_m: (up ? 1 : -1) * sheet.halfWidth * 1.296 });
        const style = { ...place, "--ty": up ? "-100%" : "0%" } as React.CSSProperties;
        return (
          <div key={b.name} className="bc" style={style}>
            <div className="bh">
              <span>{t(`loads.bracket.${bracketKey(type, b.name)}`, { defaultValue: b.name })}</span>
              {b.height_m !== undefined && (
                <span className="high">
                  {millimetres(b.height_m, { decimals: 1 })} <u>mm</u>
                </span>
              )}
              <b>
                {kilonewtons(b.sum_n)} <u>kN</u>
              </b>
            </div>
            <Sensor name="a" sensor={b.a} limit={summary.limit} />
            <Sensor name="b" sensor={b.b} limit={summary.limit} />
          </div>
        );
      })}
    </>
  );
}

/** Force of one pin against the mean of its end: the band is as wide as the type allows, the bar twice as wide. */
function Sensor({ name, sensor, limit }: { name: string; sensor: SensorShare; limit: number }) {
  const x = 50 + 25 * Math.max(-2, Math.min(2, limit > 0 ? sensor.share / limit : 0));
  const off = Math.abs(sensor.share) > limit;
  return (
    <div className={`sb ${off ? "off" : ""}`}>
      <i>{name}</i>
      <svg viewBox="0 0 100 14" preserveAspectRatio="none" aria-hidden="true">
        <rect y="5" width="100" height="4" fill="var(--surface-3)" />
        <rect x={25} y="1.5" width={50} height="11" fill="var(--band)" />
        <rect x={x - 0.9} y="0" width="1.8" height="14" fill="var(--needle)" />
      </svg>
      <b>{kilonewtons(sensor.force_n)}</b>
    </div>
  );
}
