import { useTranslation } from "react-i18next";
import { kilonewtons } from "@/shared/words/format";
import { bracketKey, onSheet, type OnSheetProps } from "./faceplate";
import { kBandShare, summarise, type SensorShare } from "./loads";

/** A card a bracket with the forces of its two pins. */
export function ForceCards({ vehicle, type, sheet }: OnSheetProps) {
  const { t } = useTranslation("vehicles");
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
              <b>
                {kilonewtons(b.sum_n)} <u>kN</u>
              </b>
            </div>
            <Sensor name="a" sensor={b.a} />
            <Sensor name="b" sensor={b.b} />
          </div>
        );
      })}
    </>
  );
}

/** Force of one pin against the mean of its end: the band is +-10 %, the bar +-20 %. */
function Sensor({ name, sensor }: { name: string; sensor: SensorShare }) {
  const kScale = 0.2;
  const x = 50 + 50 * Math.max(-1, Math.min(1, sensor.share / kScale));
  const off = Math.abs(sensor.share) > kBandShare;
  return (
    <div className={`sb ${off ? "off" : ""}`}>
      <i>{name}</i>
      <svg viewBox="0 0 100 14" preserveAspectRatio="none" aria-hidden="true">
        <rect y="5" width="100" height="4" fill="var(--surface-3)" />
        <rect
          x={50 - (50 * kBandShare) / kScale}
          y="1.5"
          width={(100 * kBandShare) / kScale}
          height="11"
          fill="var(--band)"
        />
        <rect x={x - 0.9} y="0" width="1.8" height="14" fill="var(--needle)" />
      </svg>
      <b>{kilonewtons(sensor.force_n)}</b>
    </div>
  );
}
