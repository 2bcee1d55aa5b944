import { useTranslation } from "react-i18next";
import { StatusSymbol } from "@/shared/ui";
import { number } from "@/shared/words/format";
import type { Series } from "./statistics";
import { drawnLimits, limitDecimals, trendReach, unbroken } from "./trendScale";

/** One row of the trend: tolerance solid, control limits dashed, off-scale stops as triangles at the edge. */
export function TrendRow({
  name,
  unit,
  data,
  limit,
  slots,
}: {
  name: string;
  unit: string;
  data: Series;
  limit: number;
  /** Places along the row; this stop is the last. */
  slots: number;
}) {
  const { t } = useTranslation("records");
  const decimals = limitDecimals(limit);
  const figures = Math.min(3, decimals + 2);
  const reach = trendReach(data, limit);
  const y = (v: number) => 50 - (50 * v) / (limit * reach);
  const first = slots - data.values.length;
  const x = (i: number) => (100 * (first + i + 0.5)) / slots;
  const inside = { top: y(limit), height: y(-limit) - y(limit) };
  const runs = unbroken(data);
  const last = data.values.length - 1;
  const lines = runs
    .filter((run) => run.length > 1)
    .map((run) => `M${run.map((i) => `${x(i)} ${y(data.values[i] ?? 0)}`).join("L")}`)
    .join("");
  const dots = data.values
    .map((v, i) => (data.inScale[i] && i !== last ? `M${x(i)} ${y(v)}h0` : ""))
    .join("");
  return (
    <div className="trd">
      <div className="th">
        <b>{name}</b>
        <span className="cap">{unit}</span>
      </div>
      <div className="tw">
        <svg
          className="m"
          viewBox="0 0 100 100"
          preserveAspectRatio="none"
          role="img"
          aria-label={t("trend_plot", { name, count: data.values.length })}
        >
          <rect x="0" y={inside.top} width="100" height={inside.height} className="tin" />
          <path d="M0 50H100" className="tax" />
          <path d={`M0 ${y(limit)}H100M0 ${y(-limit)}H100`} className="ttol" />
          <path
            d={drawnLimits(data, limit)
              .map((v) => `M0 ${y(v)}H100`)
              .join("")}
            className="tctl"
          />
          <path d={lines} className="tline" />
          <path d={dots} className="tdot" />
          {data.inScale[last] && <path d={`M${x(last)} ${y(data.values[last] ?? 0)}h0`} className="tcur" />}
        </svg>
        {data.values.map((v, i) =>
          data.inScale[i] ? null : (
            <span key={i} className="off" style={{ left: `${x(i)}%`, top: v > 0 ? 0 : "calc(100% - 16px)" }}>
              <StatusSymbol name="a-2" size={16} />
            </span>
          ),
        )}
        {[limit, 0, -limit].map((v) => (
          <span key={v} className="tlv" style={{ top: `${y(v)}%` }}>
            {number(v, { decimals: v === 0 ? 0 : decimals, sign: true })}
          </span>
        ))}
      </div>
      <div className="ts">
        <span className="cap">{t("mean_abs")}</span>
        <b>{number(data.meanAbs, { decimals: figures })}</b>
        <span className="cap">{t("largest")}</span>
        <b>{number(data.largest, { decimals: figures })}</b>
      </div>
    </div>
  );
}
