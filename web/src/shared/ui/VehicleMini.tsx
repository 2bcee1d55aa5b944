import type { VehicleType } from "@/shared/api/types";
import { boxOf } from "@/shared/math/geometry";

const kWheel_m = { long: 0.2, wide: 0.09 }; // of the body's length

/** A vehicle of a type from above, forward to the right: its own outline and wheels, so that families look different. */
export function VehicleMini(props: {
  type: Pick<VehicleType, "footprint" | "wheels"> | undefined;
  selected?: boolean;
  className?: string;
}) {
  const { type, selected, className = "mini" } = props;
  if (type === undefined || type.footprint.length < 3)
    return <svg className={className} aria-hidden="true" />;
  const { minX, minY, maxX, maxY } = boxOf(type.footprint);
  const [length, width] = [maxX - minX, maxY - minY];
  const rim = 0.08 * length;
  const body = selected ? "var(--veh-sel)" : "var(--veh)";
  const mark = selected ? "var(--veh-sel-mark)" : "var(--veh-mark)";
  const tip = Math.min(0.14 * length, 0.3 * width);
  return (
    <svg
      viewBox={`${minX - rim} ${-maxY - rim} ${length + 2 * rim} ${width + 2 * rim}`}
      className={className}
      aria-hidden="true"
    >
      <path d={`M${type.footprint.map((p) => `${p.x_m} ${-p.y_m}`).join("L")}Z`} fill={body} />
      {type.wheels.map((w) => (
        <rect
          key={w.name}
          x={w.position.x_m - (kWheel_m.long * length) / 4}
          y={-w.position.y_m - (kWheel_m.wide * length) / 4}
          width={(kWheel_m.long * length) / 2}
          height={(kWheel_m.wide * length) / 2}
          fill={mark}
          opacity="0.55"
        />
      ))}
      <path
        d={`M${maxX - 0.3 * tip} 0L${maxX - 1.6 * tip} ${tip}L${maxX - 1.2 * tip} 0L${maxX - 1.6 * tip} ${-tip}Z`}
        fill={mark}
      />
    </svg>
  );
}
