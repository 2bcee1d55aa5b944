import type { StopRecord } from "@/shared/api/types";
import { beyond, emptyCorner } from "./closeUp";
import { limitText } from "./limitText";
import { ToleranceShape } from "./PlotGround";
import { marginOf, type PlotScale } from "./targetScale";
import "./Locator.css";

/** In a corner of a close-up: the whole tolerance, and in it, to scale, the piece that the close-up shows. */
export function Locator({ stop, scale }: { stop: StopRecord; scale: PlotScale }) {
  const { half } = scale;
  const tol = { x: stop.tolerance.dx_m * 1000, y: stop.tolerance.dy_m * 1000 };
  if (beyond(half, tol) === "none") return null;
  const reach = Math.max(tol.x, tol.y) * 1.12;
  const corner = emptyCorner({ x: stop.dx_m * 1000, y: stop.dy_m * 1000 });
  // Just inside the plot's frame.
  const inset = `${50 - 47 / marginOf(scale).view}%`;
  const place = { [corner.x > 0 ? "right" : "left"]: inset, [corner.y > 0 ? "top" : "bottom"]: inset };
  return (
    <div className="locator" style={place} aria-hidden="true">
      <svg className="m" viewBox={`${-reach} ${-reach} ${2 * reach} ${2 * reach}`}>
        <rect x={-reach} y={-reach} width={2 * reach} height={2 * reach} className="tout" />
        <ToleranceShape tolerance={stop.tolerance} className="tin" />
        <ToleranceShape tolerance={stop.tolerance} className="ttol" />
        <rect x={-half} y={-half} width={2 * half} height={2 * half} className="tpiece" />
      </svg>
      <span>
        ±{limitText(tol.x)}
        {tol.y !== tol.x && ` / ±${limitText(tol.y)}`} mm
      </span>
    </div>
  );
}
