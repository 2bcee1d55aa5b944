import type { Vehicle, VehicleType } from "@/shared/api/types";
import { footCorner, wheelHalf_m, wheelPlace, wheelRing_m, wheelState, type Sheet } from "./faceplate";
import { kPinOffset_m } from "./loads";

type Caster = NonNullable<VehicleType["casters"]>[number];

// Shapes of the drawing, in metres of the body frame with y turned down.

export function Body({ sheet: { halfLength: l, halfWidth: w, scale } }: { sheet: Sheet }) {
  const arrow = l + 0.99 * scale;
  return (
    <>
      <rect className="body" x={-l} y={-w} width={2 * l} height={2 * w} rx={0.16 * scale} />
      <path
        className="fine"
        d={`M${-l} ${-w * 0.4}H${l}M${-l} ${w * 0.4}H${l}M${-l * 0.36} ${-w}V${w}M${l * 0.36} ${-w}V${w}M${l * 0.82} ${-w}V${w}M${-l * 0.82} ${-w}V${w}`}
      />
      <path className="axis" d={`M${-l * 1.295} 0H${l * 1.295}M0 ${-w * 1.28}V${w * 1.28}`} />
      <path
        className="hd"
        d={`M${arrow} ${-0.2625 * scale}L${arrow + 0.45 * scale} 0L${arrow} ${0.2625 * scale}`}
      />
    </>
  );
}

export function Bracket({ x, y, edge }: { x: number; y: number; edge: number }) {
  const out = Math.sign(y || 1) * edge * 1.3;
  return (
    <>
      <path className="lead" d={`M${x} ${y}V${out}`} />
      <rect className="brk" x={x - 0.5} y={y - 0.3} width="1" height=".6" rx=".05" />
      <circle className="pin" cx={x - kPinOffset_m} cy={y} r=".12" />
      <circle className="pin" cx={x + kPinOffset_m} cy={y} r=".12" />
    </>
  );
}

export function Wheel({
  wheel,
  type,
  scale,
}: {
  wheel: Vehicle["wheels"][number];
  type: VehicleType | undefined;
  scale: number;
}) {
  const at = wheelPlace(wheel.name, type);
  if (!at) return null;
  const state = wheelState(wheel);
  const half = wheelHalf_m(at.diameter_m, scale);
  const turn = (-wheel.steering_rad * 180) / Math.PI;
  return (
    <>
      <circle
        className={`wring ${state === "warm" ? "adv" : state === "fault" ? "bad" : ""}`}
        cx={at.position.x_m}
        cy={-at.position.y_m}
        r={wheelRing_m(at.diameter_m, scale)}
      />
      <rect
        className="wheel"
        x={-half}
        y={-half / 2}
        width={2 * half}
        height={half}
        rx={0.03 * scale}
        transform={`translate(${at.position.x_m} ${-at.position.y_m}) rotate(${turn})`}
      />
    </>
  );
}

/** It turns as it is pushed, and nobody is told where to. */
export function Caster({ at, scale }: { at: Caster; scale: number }) {
  const half = wheelHalf_m(at.diameter_m, scale);
  const [x, y] = [at.position.x_m, -at.position.y_m];
  return (
    <g className="caster">
      <circle cx={x} cy={y} r={half} />
      <path d={`M${x - half} ${y}H${x + half}`} />
      <title>{at.name}</title>
    </g>
  );
}

export function Foot({ name, index, sheet }: { name: string; index: number; sheet: Sheet }) {
  const corner = footCorner(name, index);
  const x = corner.x * sheet.halfLength * 0.956;
  const y = -corner.y * sheet.halfWidth;
  return (
    <>
      <path className="lead" d={`M${x} ${y}V${y * 1.2}`} />
      <circle className="foot" cx={x} cy={y * 1.2} r={0.14 * sheet.scale} />
    </>
  );
}

export function Centre({ vehicle, type }: { vehicle: Vehicle; type: VehicleType | undefined }) {
  const at = vehicle.load_centre;
  if (!at) return null;
  const allowed = type?.load_rules?.centre;
  return (
    <>
      {allowed && <polygon className="tol" points={allowed.map((c) => `${c.x_m},${-c.y_m}`).join(" ")} />}
      <path className="col" d={`M${at.x_m - 0.2} ${-at.y_m}h.4M${at.x_m} ${-at.y_m - 0.2}v.4`} />
      <circle className="colc" cx={at.x_m} cy={-at.y_m} r=".09" />
    </>
  );
}
