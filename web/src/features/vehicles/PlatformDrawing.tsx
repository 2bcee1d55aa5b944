import { useTranslation } from "react-i18next";
import type { Vehicle, VehicleType } from "@/shared/api/types";
import { StatusSymbol } from "@/shared/ui";
import { degrees, fixed, kilonewtons, mass, millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { bracketKey, footCorner, onSheet, sheetOf, wheelState, type Sheet } from "./faceplate";
import { centreOfLoad, kBandShare, kPinOffset_m, summarise, type SensorShare } from "./loads";

export interface PlatformDrawingProps {
  vehicle: Vehicle;
  type: VehicleType | undefined;
  /** Old values stay, hatched. */
  stale: boolean;
}

/** The platform from above (Tang 2020, Fig. 12): brackets with their forces, wheels, feet, centre of load. */
export function PlatformDrawing({ vehicle, type, stale }: PlatformDrawingProps) {
  const { t } = useTranslation("vehicles");
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
        <Forces vehicle={vehicle} type={type} sheet={sheet} />
        <WheelLabels vehicle={vehicle} type={type} sheet={sheet} />
        <LoadLabels vehicle={vehicle} type={type} sheet={sheet} />
      </div>
    </div>
  );
}

function Body({ sheet: { halfLength: l, halfWidth: w, scale } }: { sheet: Sheet }) {
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

function Bracket({ x, y, edge }: { x: number; y: number; edge: number }) {
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

function wheelPlace(name: string, type: VehicleType | undefined) {
  return type?.wheels.find((w) => w.name === name);
}

function Wheel({
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
  const half = Math.max(0.15 * scale, at.diameter_m / 2);
  const turn = (-wheel.steering_rad * 180) / Math.PI;
  return (
    <>
      <circle
        className={`wring ${state === "warm" ? "adv" : state === "fault" ? "bad" : ""}`}
        cx={at.position.x_m}
        cy={-at.position.y_m}
        r={Math.max(0.27 * scale, half + 0.06 * scale)}
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

function Foot({ name, index, sheet }: { name: string; index: number; sheet: Sheet }) {
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

function Centre({ vehicle, type }: { vehicle: Vehicle; type: VehicleType | undefined }) {
  const at = centreOfLoad(vehicle.brackets, type);
  if (!at) return null;
  return (
    <>
      <ellipse className="tol" cx={at.x_m} cy={0} rx=".62" ry=".2" />
      <path className="col" d={`M${at.x_m - 0.2} ${-at.y_m}h.4M${at.x_m} ${-at.y_m - 0.2}v.4`} />
      <circle className="colc" cx={at.x_m} cy={-at.y_m} r=".09" />
    </>
  );
}

function Forces({ vehicle, type, sheet }: { vehicle: Vehicle; type: VehicleType | undefined; sheet: Sheet }) {
  const { t } = useTranslation("vehicles");
  const summary = summarise(vehicle, type);
  if (!summary) return null;
  return (
    <>
      {summary.brackets.map((b) => {
        const at = type?.brackets.find((x) => x.name === b.name)?.position;
        if (!at) return null;
        const up = at.y_m >= 0;
        const place = onSheet(sheet, { x_m: at.x_m, y_m: (up ? 1 : -1) * sheet.halfWidth * 1.296 });
        const style = { ...place, "--ty": up ? "-100%" : "0%" } as React.CSSProperties;
        return (
          <div key={b.name} className="bc" style={style}>
            <div className="bh">
              <span>{t(`loads.bracket.${bracketKey(type, b.name)}`, { defaultValue: b.name })}</span>
              <b>
                {kilonewtons(b.sum_n)} <u>kN</u>
              </b>
            </div>
            <Sensor name="a" sensor={b.a} />
            <Sensor name="b" sensor={b.b} />
          </div>
        );
      })}
    </>
  );
}

/** Force of one pin against the mean of its end: the band is +-10 %, the bar +-20 %. */
function Sensor({ name, sensor }: { name: string; sensor: SensorShare }) {
  const kScale = 0.2;
  const x = 50 + 50 * Math.max(-1, Math.min(1, sensor.share / kScale));
  const off = Math.abs(sensor.share) > kBandShare;
  return (
    <div className={`sb ${off ? "off" : ""}`}>
      <i>{name}</i>
      <svg viewBox="0 0 100 14" preserveAspectRatio="none" aria-hidden="true">
        <rect y="5" width="100" height="4" fill="var(--surface-3)" />
        <rect
          x={50 - (50 * kBandShare) / kScale}
          y="1.5"
          width={(100 * kBandShare) / kScale}
          height="11"
          fill="var(--band)"
        />
        <rect x={x - 0.9} y="0" width="1.8" height="14" fill="var(--needle)" />
      </svg>
      <b>{kilonewtons(sensor.force_n)}</b>
    </div>
  );
}

function WheelLabels({
  vehicle,
  type,
  sheet,
}: {
  vehicle: Vehicle;
  type: VehicleType | undefined;
  sheet: Sheet;
}) {
  const { t } = useTranslation("vehicles");
  const words = useWords();
  const row = sheet.height * 0.049;
  return (
    <>
      {vehicle.wheels.map((w) => {
        const at = wheelPlace(w.name, type);
        if (!at) return null;
        const state = wheelState(w);
        const { x_m: x, y_m: y } = at.position;
        const middle = Math.abs(y) < sheet.halfWidth * 0.3;
        const inside = middle || Math.abs(x) < sheet.halfLength * 0.3;
        const side = x < 0 || !middle ? "from" : "to"; // of the wheel, where its words stand
        const place = inside
          ? onSheet(sheet, { x_m: x + (side === "from" ? 0.34 : -0.34) * sheet.scale, y_m: y })
          : onSheet(sheet, {
              x_m: Math.sign(x) * sheet.halfLength * 1.143,
              y_m: Math.sign(y) * sheet.height * 0.246,
            });
        const below = onSheet(sheet, {
          x_m: Math.sign(x) * sheet.halfLength * 1.143,
          y_m: Math.sign(y) * sheet.height * 0.246 - (y >= 0 ? 2 : 2.2) * row,
        });
        return (
          <span key={w.name}>
            <span className={`wl ${inside ? `in ${side}` : ""}`} style={place}>
              {state !== "ok" && <StatusSymbol name={state === "warm" ? "a-3" : "a-2"} />}
              <b>{w.name}</b> {degrees(w.steering_rad, { decimals: 1, sign: true })}°
              {middle && (
                <span>
                  {fixed(w.speed_mps, 2)}
                  <u> m/s</u>
                </span>
              )}
            </span>
            {state !== "ok" && (
              <span
                className={`wl ${state === "warm" ? "adv2" : "bad2"} ${inside ? side : ""}`}
                style={inside ? { ...place, marginTop: 22 } : below}
              >
                {state === "warm"
                  ? t("loads.servo", { temperature: fixed(w.temperature_c, 0) })
                  : words.fault(w.fault)}
              </span>
            )}
          </span>
        );
      })}
      {vehicle.parking_feet.map((f, i) => {
        const corner = footCorner(f.name, i);
        const place = onSheet(sheet, {
          x_m: corner.x * sheet.halfLength * 1.143,
          y_m: corner.y * sheet.height * 0.246 - row,
        });
        return (
          <span key={f.name} className="wl" style={place}>
            {t("loads.foot")} {millimetres(f.extension_m, { decimals: 1 })} <u>mm</u>
          </span>
        );
      })}
    </>
  );
}

function LoadLabels({
  vehicle,
  type,
  sheet,
}: {
  vehicle: Vehicle;
  type: VehicleType | undefined;
  sheet: Sheet;
}) {
  const { t } = useTranslation("vehicles");
  const summary = summarise(vehicle, type);
  const centre = centreOfLoad(vehicle.brackets, type);
  if (type?.brackets.length === 0) return null;
  if (!summary) {
    return (
      <span className="wl in" style={{ left: "50%", top: "38%" }}>
        {t("loads.none")}
      </span>
    );
  }
  return (
    <>
      <span className="wl in" style={onSheet(sheet, { x_m: 0, y_m: sheet.halfWidth * 0.68 })}>
        <b>{kilonewtons(summary.total_n)} kN</b> {mass(summary.total_n / 9.80665)}
      </span>
      {centre && (
        <span className="wl in" style={onSheet(sheet, { x_m: centre.x_m, y_m: -sheet.halfWidth * 0.5 })}>
          {t(`loads.centre_${centre.x_m < 0 ? "aft" : "fore"}_${centre.y_m >= 0 ? "left" : "right"}`, {
            aft: millimetres(Math.abs(centre.x_m)),
            left: millimetres(Math.abs(centre.y_m)),
          })}
        </span>
      )}
    </>
  );
}
