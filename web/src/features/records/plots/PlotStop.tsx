import type { StopRecord } from "@/shared/api/types";
import { headingFactor, rayLength } from "./targetScale";

/** This stop: its vector from the drawing's place, and its heading, larger than it is, inside its own tolerance. */
export function PlotStop({ stop, half }: { stop: StopRecord; half: number }) {
  const at = { x: stop.dx_m * 1000, y: stop.dy_m * 1000 };
  const factor = headingFactor(stop);
  const length = rayLength(at.y, half);
  const limit = Math.min(Math.PI * 0.45, stop.tolerance.dheading_rad * factor);
  const turn = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, stop.dheading_rad * factor));
  // The wedge stands on the stop; nominal heading is up, ccw is to the left.
  const ray = (a: number) => `${at.x - Math.sin(a) * length} ${-at.y - Math.cos(a) * length}`;
  return (
    <>
      <path
        d={`M${at.x} ${-at.y}L${ray(limit)}A${length} ${length} 0 0 1 ${ray(-limit)}Z`}
        className="twedge"
      />
      <path d={`M${at.x} ${-at.y}L${ray(0)}`} className="tnom" />
      <path d={`M${at.x} ${-at.y}L${ray(turn)}`} className="thd" />
      <path d={`M0 0L${at.x} ${-at.y}`} className="tvec" />
      <path d={`M${at.x} ${-at.y}h0`} className="tcur0" />
      <path d={`M${at.x} ${-at.y}h0`} className="tcur" />
    </>
  );
}
