import { useTranslation } from "react-i18next";
import { StatusSymbol } from "@/shared/ui";
import { degrees, fixed, kilonewtons, millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { footCorner, onSheet, wheelPlace, wheelRing_m, wheelState, type OnSheetProps } from "./faceplate";

/** From here on a foot stands: below, its sensor shows noise. */
const kStands_n = 500;

/** Where words beside the body stand, as a share of half its length. */
const kBeside = 1.06;

/** Words beside wheels and parking feet. */
export function WheelLabels({ vehicle, type, sheet }: OnSheetProps) {
  const { t } = useTranslation("body");
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
        const beside = wheelRing_m(at.diameter_m, sheet.scale) + 0.07 * sheet.scale;
        const outer = x < 0 ? "to" : "from"; // beside the body words begin, or end, at one line
        const place = inside
          ? onSheet(sheet, { x_m: x + (side === "from" ? beside : -beside), y_m: y })
          : onSheet(sheet, {
              x_m: Math.sign(x) * sheet.halfLength * kBeside,
              y_m: Math.sign(y) * sheet.height * 0.246,
            });
        const below = onSheet(sheet, {
          x_m: Math.sign(x) * sheet.halfLength * kBeside,
          y_m: Math.sign(y) * sheet.height * 0.246 - (y >= 0 ? 2 : 2.2) * row,
        });
        return (
          <span key={w.name}>
            <span className={`wl ${inside ? `in ${side}` : outer}`} style={place}>
              {state !== "ok" && <StatusSymbol name={state === "warm" ? "a-3" : "a-2"} />}
              <b>{words.wheelLabel(w.name)}</b> {degrees(w.steering_rad, { decimals: 1, sign: true })}°
              {middle && (
                <span>
                  {fixed(w.speed_mps, 2)}
                  <u> m/s</u>
                </span>
              )}
            </span>
            {state !== "ok" && (
              <span
                className={`wl ${state === "warm" ? "adv2" : "bad2"} ${inside ? side : outer}`}
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
          x_m: corner.x * sheet.halfLength * kBeside,
          y_m: corner.y * sheet.height * 0.246 - row,
        });
        return (
          <span key={f.name} className={`wl ${corner.x < 0 ? "to" : "from"}`} style={place}>
            {t("loads.foot")} {millimetres(f.extension_m, { decimals: 1 })} <u>mm</u>
            {f.force_n !== undefined && f.force_n > kStands_n && (
              <span>
                {kilonewtons(f.force_n)} <u>kN</u>
              </span>
            )}
          </span>
        );
      })}
    </>
  );
}
