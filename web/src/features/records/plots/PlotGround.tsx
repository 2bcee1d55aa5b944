import type { StopRecord } from "@/shared/api/types";
import { ticksOf, type PlotScale } from "./targetScale";

/** What the stops lie on: the tolerance, and the grid in hall axes. */
export function PlotGround({ tolerance, scale }: { tolerance: StopRecord["tolerance"]; scale: PlotScale }) {
  const { half } = scale;
  const grid = ticksOf(scale)
    .map((v) => `M${v} ${-half}V${half}M${-half} ${v}H${half}`)
    .join("");
  return (
    <>
      <rect x={-half} y={-half} width={2 * half} height={2 * half} className="tout" />
      <ToleranceShape tolerance={tolerance} className="tin" />
      <path d={grid} className="tg" />
      <path d={`M${-half} 0H${half}M0 ${-half}V${half}`} className="tax" />
      <ToleranceShape tolerance={tolerance} className="ttol" />
    </>
  );
}

export function ToleranceShape({
  tolerance,
  className,
}: {
  tolerance: StopRecord["tolerance"];
  className: string;
}) {
  const x = tolerance.dx_m * 1000;
  const y = tolerance.dy_m * 1000;
  return tolerance.shape === "ellipse" ? (
    <ellipse rx={x} ry={y} className={className} />
  ) : (
    <rect x={-x} y={-y} width={2 * x} height={2 * y} className={className} />
  );
}
