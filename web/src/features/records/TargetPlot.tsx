import { useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import { degrees, millimetres, number } from "@/shared/words/format";
import { ellipse95 } from "./statistics";
import { headingFactor, labelSide, plotScale, rayLength, toleranceLabelSide } from "./targetScale";
import { limitDecimals } from "./trendScale";

/** Deviation in the hall frame: tolerance, earlier stops, this one with its vector and heading. */
export function TargetPlot({ stop, earlier }: { stop: StopRecord; earlier: readonly StopRecord[] }) {
  const { t } = useTranslation("records");
  const { half, step } = plotScale(stop);
  const view = half * 1.133;
  const mm = (v: number) => v * 1000;
  const inScale = earlier.filter((s) => Math.abs(mm(s.dx_m)) <= half && Math.abs(mm(s.dy_m)) <= half);
  const ellipse = ellipse95(inScale.map((s) => ({ x: mm(s.dx_m), y: mm(s.dy_m) })));
  const at = { x: mm(stop.dx_m), y: mm(stop.dy_m) };
  const ticks: number[] = [];
  for (let v = -Math.floor(half / step) * step; v <= half; v += step) ticks.push(Math.round(v * 1000) / 1000);
  const grid = ticks.map((v) => `M${v} ${-half}V${half}M${-half} ${v}H${half}`).join("");
  const percent = (v: number) => `${50 + (50 * v) / view}%`;
  const tol = { x: mm(stop.tolerance.dx_m), y: mm(stop.tolerance.dy_m) };
  const factor = headingFactor(stop);
  const wedge = rayLength(at.y, half);
  const lim = Math.min(Math.PI * 0.45, stop.tolerance.dheading_rad * factor);
  const turn = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, stop.dheading_rad * factor));
  // The wedge stands on the stop; nominal heading is up, ccw is to the left.
  const ray = (a: number, l = wedge) => `${at.x - Math.sin(a) * l} ${-at.y - Math.cos(a) * l}`;
  const label = `${millimetres(stop.dx_m, { decimals: 2, sign: true })}, ${millimetres(stop.dy_m, { decimals: 2, sign: true })}`;
  const side = labelSide(at.x, half);
  return (
    <div className="mapbox tb" style={{ "--ar": "1" } as React.CSSProperties}>
      <div className="stage">
        <svg
          className="m"
          viewBox={`${-view} ${-view} ${2 * view} ${2 * view}`}
          role="img"
          aria-label={`${t("target")}: ${t("target_text", {
            dx: millimetres(stop.dx_m, { decimals: 2, sign: true }),
            dy: millimetres(stop.dy_m, { decimals: 2, sign: true }),
            dh: degrees(stop.dheading_rad, { sign: true }),
          })}`}
        >
          <rect x={-half} y={-half} width={2 * half} height={2 * half} className="tout" />
          {stop.tolerance.shape === "ellipse" ? (
            <ellipse rx={tol.x} ry={tol.y} className="tin" />
          ) : (
            <rect x={-tol.x} y={-tol.y} width={2 * tol.x} height={2 * tol.y} className="tin" />
          )}
          <path d={grid} className="tg" />
          <path d={`M${-half} 0H${half}M0 ${-half}V${half}`} className="tax" />
          {stop.tolerance.shape === "ellipse" ? (
            <ellipse rx={tol.x} ry={tol.y} className="ttol" />
          ) : (
            <rect x={-tol.x} y={-tol.y} width={2 * tol.x} height={2 * tol.y} className="ttol" />
          )}
          {ellipse && (
            <ellipse
              rx={ellipse.rx}
              ry={ellipse.ry}
              transform={`translate(${ellipse.cx} ${-ellipse.cy}) rotate(${(-ellipse.angle_rad * 180) / Math.PI})`}
              className="tctl"
            />
          )}
          <path d={inScale.map((s) => `M${mm(s.dx_m)} ${-mm(s.dy_m)}h0`).join("")} className="tdot" />
          <path
            d={`M${at.x} ${-at.y}L${ray(lim)}A${wedge} ${wedge} 0 0 1 ${ray(-lim)}Z`}
            className="twedge"
          />
          <path d={`M${at.x} ${-at.y}L${ray(0)}`} className="tnom" />
          <path d={`M${at.x} ${-at.y}L${ray(turn)}`} className="thd" />
          <path d={`M0 0L${at.x} ${-at.y}`} className="tvec" />
          <path d={`M${at.x} ${-at.y}h0`} className="tcur0" />
          <path d={`M${at.x} ${-at.y}h0`} className="tcur" />
          <rect x={-half} y={-half} width={2 * half} height={2 * half} className="tfr" />
        </svg>
        {ticks
          .filter((v) => Math.abs(v) < half * 0.9)
          .map((v) => (
            <span key={v}>
              <span className="lb ax" style={{ left: percent(v), top: percent(half * 1.08) }}>
                {number(v, { decimals: limitDecimals(step), sign: true })}
              </span>
              <span className="lb ax" style={{ left: percent(-half * 1.08), top: percent(-v) }}>
                {number(v, { decimals: limitDecimals(step), sign: true })}
              </span>
            </span>
          ))}
        <span className="lb ax b" style={{ left: percent(half * 0.95), top: percent(half * 1.08) }}>
          dx
        </span>
        <span className="lb ax b" style={{ left: percent(-half * 1.08), top: percent(-half * 0.95) }}>
          dy
        </span>
        <span
          className="lb tlb b"
          style={{ left: percent(tol.x * 0.72), top: percent(-tol.y * 0.93 * toleranceLabelSide(at, half)) }}
        >
          ±{number(tol.x, { decimals: limitDecimals(tol.x) })}
          {tol.y !== tol.x && ` / ±${number(tol.y, { decimals: limitDecimals(tol.y) })}`} mm
        </span>
        {ellipse && (
          <span
            className="lb tlb"
            style={{
              left: percent(ellipse.cx + ellipse.rx * 0.75),
              top: percent(-ellipse.cy + ellipse.ry * 0.85),
            }}
          >
            {t("ellipse")}
          </span>
        )}
        <span
          className="lb tcurl"
          style={{ left: percent(at.x + side * half * 0.33), top: percent(-at.y + half * 0.08) }}
        >
          {label}
        </span>
        <span className="lb tlb" style={{ left: percent(at.x), top: percent(-at.y - wedge * 1.08) }}>
          {t("heading_wedge", { factor })}
        </span>
      </div>
    </div>
  );
}
