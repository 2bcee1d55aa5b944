import { useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import { degrees, millimetres } from "@/shared/words/format";
import { Locator } from "./Locator";
import { PlotGround } from "./PlotGround";
import { PlotLabels } from "./PlotLabels";
import { PlotStop } from "./PlotStop";
import { ellipse95, type Ellipse } from "./statistics";
import { marginOf, type PlotScale } from "./targetScale";
import "./plots.css";
import "./TargetPlot.css";

/** Deviation in the hall frame: tolerance, earlier stops, this one with its vector and heading. */
export function TargetPlot({
  stop,
  earlier,
  scale,
}: {
  stop: StopRecord;
  earlier: readonly StopRecord[];
  scale: PlotScale;
}) {
  const { t } = useTranslation("records");
  const { half } = scale;
  const view = half * marginOf(scale).view;
  const points = earlier
    .map((s) => ({ x: s.dx_m * 1000, y: s.dy_m * 1000 }))
    .filter((p) => Math.abs(p.x) <= half && Math.abs(p.y) <= half);
  const ellipse = ellipse95(points);
  const values = {
    dx: millimetres(stop.dx_m, { decimals: 2, sign: true }),
    dy: millimetres(stop.dy_m, { decimals: 2, sign: true }),
    dh: degrees(stop.dheading_rad, { sign: true }),
  };
  return (
    <div className="mapbox tb" style={{ "--ar": "1" } as React.CSSProperties}>
      <div className="stage">
        <svg
          className="m"
          viewBox={`${-view} ${-view} ${2 * view} ${2 * view}`}
          role="img"
          aria-label={`${t("target")}: ${t("target_text", values)}`}
        >
          {/* Cuts at the frame what reaches beyond it: a tolerance, an ellipse. */}
          <svg
            x={-half}
            y={-half}
            width={2 * half}
            height={2 * half}
            viewBox={`${-half} ${-half} ${2 * half} ${2 * half}`}
          >
            <PlotGround tolerance={stop.tolerance} scale={scale} />
            {ellipse && <Spread ellipse={ellipse} />}
            <path d={points.map((p) => `M${p.x} ${-p.y}h0`).join("")} className="tdot" />
          </svg>
          <PlotStop stop={stop} half={half} />
          <rect x={-half} y={-half} width={2 * half} height={2 * half} className="tfr" />
        </svg>
        <PlotLabels stop={stop} ellipse={ellipse} scale={scale} />
        <Locator stop={stop} scale={scale} />
      </div>
    </div>
  );
}

/** Where 95 % of the earlier stops are expected. */
function Spread({ ellipse: e }: { ellipse: Ellipse }) {
  return (
    <ellipse
      rx={e.rx}
      ry={e.ry}
      transform={`translate(${e.cx} ${-e.cy}) rotate(${(-e.angle_rad * 180) / Math.PI})`}
      className="tctl"
    />
  );
}
