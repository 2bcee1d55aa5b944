import { useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import { StatusSymbol } from "@/shared/ui";
import { degrees, millimetres } from "@/shared/words/format";
import "./LastStopBands.css";

/** The last stop as two small bands: distance and heading against the tolerance. */
export function LastStopBands({ stop, time }: { stop: StopRecord; time: string }) {
  const { t } = useTranslation("stations");
  const limit = Math.min(stop.tolerance.dx_m, stop.tolerance.dy_m);
  const most = Math.max(Math.abs(stop.dx_m), Math.abs(stop.dy_m));
  return (
    <div className="laststop">
      <span className="cap">
        {t("last_stop")} {time}
      </span>
      <div className="row">
        <StatusSymbol name={stop.inside ? "c-ok" : "a-2"} size={16} />
        <b>
          {millimetres(stop.dx_m, { decimals: 1, sign: true })},{" "}
          {millimetres(stop.dy_m, { decimals: 1, sign: true })} mm
        </b>
        <b>{degrees(stop.dheading_rad, { sign: true })}°</b>
      </div>
      <Band share={most / limit} />
      <Band share={Math.abs(stop.dheading_rad) / stop.tolerance.dheading_rad} />
    </div>
  );
}

function Band({ share }: { share: number }) {
  const x = Math.min(1.2, share) * 83.3;
  return (
    <svg viewBox="0 0 100 8" preserveAspectRatio="none" aria-hidden="true">
      <rect width="100" height="4" y="2" fill="var(--surface-3)" />
      <rect width="83.3" height="6" y="1" fill="var(--band)" />
      <rect x={Math.max(0, x - 0.6)} width="1.2" height="8" fill="var(--needle)" />
    </svg>
  );
}
