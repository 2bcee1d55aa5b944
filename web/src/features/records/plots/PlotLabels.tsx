import type { ReactNode } from "react";
import { useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import { millimetres, number } from "@/shared/words/format";
import { beyond } from "./closeUp";
import { limitText } from "./limitText";
import type { Ellipse } from "./statistics";
import {
  ellipseLabel,
  headingFactor,
  labelSide,
  marginOf,
  rayLength,
  ticksOf,
  toleranceLabelSide,
  type PlotScale,
} from "./targetScale";
import { limitDecimals } from "./trendScale";

/** What is written in the plot, in screen pixels; places are millimetres in hall axes. */
export function PlotLabels({
  stop,
  ellipse,
  scale,
}: {
  stop: StopRecord;
  ellipse: Ellipse | undefined;
  scale: PlotScale;
}) {
  const { t } = useTranslation("records");
  const { half } = scale;
  const at = { x: stop.dx_m * 1000, y: stop.dy_m * 1000 };
  const label = { x: at.x + labelSide(at.x, half) * half * 0.33, y: at.y - half * 0.08 };
  const spread = ellipse && ellipseLabel(ellipse, label, half);
  const mm = (m: number) => millimetres(m, { decimals: 2, sign: true });
  return (
    <>
      <Axes scale={scale} />
      <ToleranceLabel stop={stop} scale={scale} />
      {spread && (
        <Label at={spread} scale={scale} className="tlb">
          {t("ellipse")}
        </Label>
      )}
      <Label at={label} scale={scale} className="tcurl">
        {mm(stop.dx_m)}, {mm(stop.dy_m)}
      </Label>
      <Label at={{ x: at.x, y: at.y + rayLength(at.y, half) * 1.08 }} scale={scale} className="tlb">
        {t("heading_wedge", { factor: headingFactor(stop) })}
      </Label>
    </>
  );
}

interface LabelProps {
  at: { x: number; y: number };
  scale: PlotScale;
  className: string;
  children: ReactNode;
}

function Label({ at, scale, className, children }: LabelProps) {
  const view = scale.half * marginOf(scale).view;
  const percent = (v: number) => `${50 + (50 * v) / view}%`;
  return (
    <span className={`lb ${className}`} style={{ left: percent(at.x), top: percent(-at.y) }}>
      {children}
    </span>
  );
}

function Axes({ scale }: { scale: PlotScale }) {
  const { half, step } = scale;
  const edge = -half * marginOf(scale).numbers;
  const text = (v: number) => number(v, { decimals: limitDecimals(step), sign: true });
  return (
    <>
      {ticksOf(scale)
        .filter((v) => Math.abs(v) < half * 0.9)
        .flatMap((v) => [
          <Label key={`x${v}`} at={{ x: v, y: edge }} scale={scale} className="ax">
            {text(v)}
          </Label>,
          <Label key={`y${v}`} at={{ x: edge, y: v }} scale={scale} className="ax">
            {text(v)}
          </Label>,
        ])}
      <Label at={{ x: half * 0.95, y: edge }} scale={scale} className="ax b">
        dx
      </Label>
      <Label at={{ x: edge, y: half * 0.95 }} scale={scale} className="ax b">
        dy
      </Label>
    </>
  );
}

/** Beside the tolerance's corner; the locator says it where that corner is out of the picture. */
function ToleranceLabel({ stop, scale }: { stop: StopRecord; scale: PlotScale }) {
  const { half } = scale;
  const tol = { x: stop.tolerance.dx_m * 1000, y: stop.tolerance.dy_m * 1000 };
  if (beyond(half, tol) !== "none") return null;
  const side = toleranceLabelSide({ x: stop.dx_m * 1000, y: stop.dy_m * 1000 }, half);
  return (
    <Label at={{ x: tol.x * 0.72, y: tol.y * 0.93 * side }} scale={scale} className="tlb b">
      ±{limitText(tol.x)}
      {tol.y !== tol.x && ` / ±${limitText(tol.y)}`} mm
    </Label>
  );
}
