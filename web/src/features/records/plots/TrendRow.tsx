import { useTranslation } from "react-i18next";
import { StatusSymbol } from "@/shared/ui";
import { number } from "@/shared/words/format";
import type { Series } from "./statistics";
import type { TrendData } from "./trendRows";
import { limitDecimals, limitsWithin, trendReach, unbroken } from "./trendScale";
import "./TrendRow.css";

export interface TrendRowProps {
  row: TrendData;
  close: boolean;
  /** Places along the row; this stop is the last. */
  slots: number;
}

/** One row of the trend: tolerance solid, control limits dashed, off-scale stops as triangles at the edge. */
export function TrendRow({ row, close, slots }: TrendRowProps) {
  const { t } = useTranslation("records");
  const { name, unit, data, limit } = row;
  const half = close ? row.closeUp : undefined;
  const top = half ?? limit * trendReach(data, limit);
  const first = slots - data.values.length;
  const place: Place = {
    x: (i) => (100 * (first + i + 0.5)) / slots,
    y: (v) => 50 - (50 * v) / top,
  };
  return (
    <div className="trd">
      <div className="th">
        <b>{name}</b>
        <span className="cap">{unit}</span>
      </div>
      <div className={half === undefined ? "tw" : "tw close"}>
        <svg
          className="m"
          viewBox="0 0 100 100"
          preserveAspectRatio="none"
          role="img"
          aria-label={t("trend_plot", { name, count: data.values.length })}
        >
          <Ground place={place} limit={limit} top={top} limits={limitsWithin(data, top)} />
          <Stops place={place} data={data} />
        </svg>
        {data.values.map((v, i) =>
          data.inScale[i] ? null : (
            <span
              key={i}
              className="off"
              style={{ left: `${place.x(i)}%`, top: v > 0 ? 0 : "calc(100% - 16px)" }}
            >
              <StatusSymbol name="a-2" size={16} />
            </span>
          ),
        )}
        <Ticks place={place} edge={half ?? limit} {...(half !== undefined && { beyond: limit })} />
      </div>
      <Figures data={data} limit={half ?? limit} />
    </div>
  );
}

interface Place {
  x: (i: number) => number;
  y: (v: number) => number;
}

function Ground({
  place,
  limit,
  top,
  limits,
}: {
  place: Place;
  limit: number;
  top: number;
  limits: number[];
}) {
  const inside = Math.min(limit, top);
  const line = (v: number) => `M0 ${place.y(v)}H100`;
  return (
    <>
      <rect
        x="0"
        y={place.y(inside)}
        width="100"
        height={place.y(-inside) - place.y(inside)}
        className="tin"
      />
      <path d={line(0)} className="tax" />
      {limit <= top && <path d={line(limit) + line(-limit)} className="ttol" />}
      <path d={limits.map(line).join("")} className="tctl" />
    </>
  );
}

function Stops({ place, data }: { place: Place; data: Series }) {
  const last = data.values.length - 1;
  const at = (i: number) => `${place.x(i)} ${place.y(data.values[i] ?? 0)}`;
  const lines = unbroken(data)
    .filter((run) => run.length > 1)
    .map((run) => `M${run.map(at).join("L")}`);
  const dots = data.values.map((_, i) => (data.inScale[i] && i !== last ? `M${at(i)}h0` : ""));
  return (
    <>
      <path d={lines.join("")} className="tline" />
      <path d={dots.join("")} className="tdot" />
      {data.inScale[last] && <path d={`M${at(last)}h0`} className="tcur" />}
    </>
  );
}

/** Values beside the row. `beyond`: the tolerance lies farther out, and an arrow says where. */
function Ticks({ place, edge, beyond }: { place: Place; edge: number; beyond?: number }) {
  const text = (v: number) => number(v, { decimals: v === 0 ? 0 : limitDecimals(v), sign: true });
  const at = (v: number) => (beyond === undefined || v === 0 ? { top: `${place.y(v)}%` } : {});
  return (
    <>
      <span className="tlv high" style={at(edge)}>
        {text(edge)}
        {beyond !== undefined && <b>↑ {text(beyond)}</b>}
      </span>
      <span className="tlv" style={at(0)}>
        0
      </span>
      <span className="tlv low" style={at(-edge)}>
        {beyond !== undefined && <b>↓ {text(-beyond)}</b>}
        {text(-edge)}
      </span>
    </>
  );
}

function Figures({ data, limit }: { data: Series; limit: number }) {
  const { t } = useTranslation("records");
  const decimals = Math.min(3, limitDecimals(limit) + 2);
  return (
    <div className="ts">
      <span className="cap">{t("mean_abs")}</span>
      <b>{number(data.meanAbs, { decimals })}</b>
      <span className="cap">{t("largest")}</span>
      <b>{number(data.largest, { decimals })}</b>
    </div>
  );
}
