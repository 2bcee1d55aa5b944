import { useTranslation } from "react-i18next";
import type { Vehicle, VehicleType } from "@/shared/api/types";
import { Body, Bracket, Caster, Centre, Foot, Wheel } from "./DrawingShapes";
import { sheetOf } from "./faceplate";
import { ForceCards } from "./ForceCards";
import { LoadLabels } from "./LoadLabels";
import { WheelLabels } from "./WheelLabels";
import "./PlatformDrawing.css";
import "./SheetLabels.css";

export interface PlatformDrawingProps {
  vehicle: Vehicle;
  type: VehicleType | undefined;
  /** Old values stay, hatched. */
  stale: boolean;
}

/** The platform from above (Tang 2020, Fig. 12): brackets with their forces, wheels, feet, centre of load. */
export function PlatformDrawing({ vehicle, type, stale }: PlatformDrawingProps) {
  const { t } = useTranslation("body");
  const sheet = sheetOf(type);
  const { width, height } = sheet;
  return (
    <div
      className={`mapbox pbox ${stale ? "stale" : ""}`}
      style={{ "--ar": String(width / height) } as React.CSSProperties}
    >
      <div className="stage">
        <svg
          className="m"
          viewBox={`${-width / 2} ${-height / 2} ${width} ${height}`}
          role="img"
          aria-label={t("loads.plan")}
        >
          <Body sheet={sheet} />
          {type?.brackets.map((b) => (
            <Bracket key={b.name} x={b.position.x_m} y={-b.position.y_m} edge={sheet.halfWidth} />
          ))}
          {type?.casters?.map((c) => (
            <Caster key={c.name} at={c} scale={sheet.scale} />
          ))}
          {vehicle.wheels.map((w) => (
            <Wheel key={w.name} wheel={w} type={type} scale={sheet.scale} />
          ))}
          {vehicle.parking_feet.map((f, i) => (
            <Foot key={f.name} name={f.name} index={i} sheet={sheet} />
          ))}
          {type?.cameras.map((c) => (
            <rect
              key={c.name}
              className="camb"
              x={
                Math.sign(c.body_from_camera.x_m) * (sheet.halfLength + 0.096 * sheet.scale) -
                0.088 * sheet.scale
              }
              y={-0.07 * sheet.scale}
              width={0.176 * sheet.scale}
              height={0.14 * sheet.scale}
            />
          ))}
          <Centre vehicle={vehicle} type={type} />
        </svg>
        <ForceCards vehicle={vehicle} type={type} sheet={sheet} />
        <WheelLabels vehicle={vehicle} type={type} sheet={sheet} />
        <LoadLabels vehicle={vehicle} type={type} sheet={sheet} />
      </div>
    </div>
  );
}
