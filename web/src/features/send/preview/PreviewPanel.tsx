import { useTranslation } from "react-i18next";
import type { ModeOption, Plant, Station } from "@/shared/api/types";
import { useServerNow } from "@/shared/live";
import { degrees, duration, kNone, millimetres, number, timeOfDay } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { deviationValues } from "./moveWords";
import type { StepPreview } from "./preview";
import "./PreviewPanel.css";

/** Time, clearance and expected deviation of the chosen mode, each against its limit. */
export function Measures(props: {
  option: ModeOption | undefined;
  step: StepPreview | undefined;
  station: Station | undefined;
  plant: Plant | undefined;
}) {
  const { option, step, station } = props;
  const { t } = useTranslation("send");
  const words = useWords();
  const now = useServerNow(1000);
  const ready = option?.duration_s === undefined ? undefined : now + option.duration_s * 1000;
  const expected = step?.expected_deviation;
  const nearest = option?.nearest;
  const deviation =
    option?.expected_deviation && t("mode.deviation", deviationValues(option.expected_deviation));
  return (
    <div className="mets">
      <div className="met">
        <span className="cap">{t("preview.time")}</span>
        <div className="val">
          <b>{duration(option?.duration_s)}</b>
          <u>min</u>
        </div>
        <span className="cap">
          {ready === undefined ? kNone : t("preview.ready_at", { time: timeOfDay(ready) })}
        </span>
      </div>
      <div className="met">
        <span className="cap">{t("preview.clearance")}</span>
        <div className="val">
          <b>{number(option?.clearance_m, { decimals: 2 })}</b>
          <u>m</u>
        </div>
        <span className="cap">{nearest ? (words.names.vehicle(nearest) ?? nearest) : kNone}</span>
      </div>
      <div className="met wide2">
        <span className="cap">
          {t("preview.expected", { number: station?.number ?? kNone })}
          {expected && `${t("words.join")}${t("preview.from_stops", { count: expected.stops })}`}
        </span>
        {expected && station ? (
          <>
            <Bullet
              text={millimetres(expected.mean_m, { decimals: 1 })}
              unit="mm"
              mean={expected.mean_m}
              most={expected.max_m}
              limit={Math.min(station.tolerance.dx_m, station.tolerance.dy_m)}
              max={millimetres(expected.max_m, { decimals: 1 })}
              limitText={millimetres(Math.min(station.tolerance.dx_m, station.tolerance.dy_m))}
            />
            <Bullet
              text={`${degrees(expected.mean_rad)}°`}
              unit=""
              mean={expected.mean_rad}
              most={expected.max_rad}
              limit={station.tolerance.dheading_rad}
              max={degrees(expected.max_rad)}
              limitText={degrees(station.tolerance.dheading_rad, { decimals: 1 })}
            />
          </>
        ) : (
          <span className="lab">
            {step ? t("preview.no_stops") : kNone}
            {deviation && t("words.join") + t("preview.before_adjusting", { deviation })}
          </span>
        )}
      </div>
    </div>
  );
}

/** Mean as a needle, the largest as a bar, the tolerance as the full band. */
function Bullet(props: {
  text: string;
  unit: string;
  mean: number;
  most: number;
  limit: number;
  max: string;
  limitText: string;
}) {
  const { t } = useTranslation("send");
  const share = (v: number) => Math.min(100, Math.max(0, (100 * v) / props.limit));
  return (
    <div className="bul">
      <div className="val">
        <b>{props.text}</b>
        {props.unit && <u>{props.unit}</u>}
      </div>
      <svg viewBox="0 0 100 20" preserveAspectRatio="none" aria-hidden="true">
        <rect x="0" y="5" width="100" height="10" fill="var(--band)" />
        <rect x="0" y="5" width={share(props.most)} height="10" fill="var(--line-ctl)" />
        <rect x={Math.max(0, share(props.mean) - 1)} y="1" width="2" height="18" fill="var(--needle)" />
      </svg>
      <span className="cap">{t("preview.max", { max: props.max, limit: props.limitText })}</span>
    </div>
  );
}
