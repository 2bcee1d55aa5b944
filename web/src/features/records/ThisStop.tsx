import { useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import { Link } from "@/shared/router";
import { Card, DeviationBar } from "@/shared/ui";
import { degrees, mass, millimetres, number } from "@/shared/words/format";
import { limitDecimals } from "./plots/trendScale";
import "./ThisStop.css";

/** The three deviations of a stop on their tolerance bands, and how it was measured. */
export function ThisStop({ stop }: { stop: StopRecord }) {
  const { t } = useTranslation("records");
  const { tolerance: tol } = stop;
  const deg = (rad: number) => (rad * 180) / Math.PI;
  const limitText = (limit: number) => number(limit, { decimals: limitDecimals(limit) });
  const same = tol.dx_m === tol.dy_m;
  return (
    <Card
      className="devs"
      title={t("this")}
      right={t(same ? "tolerance" : "tolerance_xy", {
        x: limitText(tol.dx_m * 1000),
        y: limitText(tol.dy_m * 1000),
        deg: limitText(deg(tol.dheading_rad)),
      })}
    >
      <DeviationBar
        name="dx"
        value={stop.dx_m * 1000}
        limit={tol.dx_m * 1000}
        limitText={limitText(tol.dx_m * 1000)}
        text={millimetres(stop.dx_m, { decimals: 2, sign: true })}
        unit="mm"
      />
      <DeviationBar
        name="dy"
        value={stop.dy_m * 1000}
        limit={tol.dy_m * 1000}
        limitText={limitText(tol.dy_m * 1000)}
        text={millimetres(stop.dy_m, { decimals: 2, sign: true })}
        unit="mm"
      />
      <DeviationBar
        name="dθ"
        value={deg(stop.dheading_rad)}
        limit={deg(tol.dheading_rad)}
        limitText={limitText(deg(tol.dheading_rad))}
        text={`${degrees(stop.dheading_rad, { sign: true })}°`}
      />
      <HowMeasured stop={stop} />
    </Card>
  );
}

function HowMeasured({ stop }: { stop: StopRecord }) {
  const { t } = useTranslation(["records", "words"]);
  return (
    <dl>
      <dt>{t("measured_by")}</dt>
      <dd>{t(`words:method.${stop.method}`, { defaultValue: stop.method.replaceAll("_", " ") })}</dd>
      <dt>{t("codes")}</dt>
      <dd>{stop.markers.join(t("join")) || "\u2013"}</dd>
      <dt>{t("uncertainty")}</dt>
      <dd>
        ±{millimetres(stop.sigma_xy_m, { decimals: 2 })} mm, ±{degrees(stop.sigma_heading_rad)}°
      </dd>
      <dt>{t("in_station")}</dt>
      <dd>
        {t(stop.along_m >= 0 ? "along_ahead" : "along_back", {
          along: number(Math.abs(stop.along_m * 1000), { decimals: 2 }),
        })}
        {t("join")}
        {t(stop.left_m >= 0 ? "left" : "right", {
          left: number(Math.abs(stop.left_m * 1000), { decimals: 2 }),
        })}
      </dd>
      {stop.arrival && (
        <>
          <dt>{t("arrival")}</dt>
          <dd>
            {t("arrival_off", {
              off: millimetres(Math.hypot(stop.arrival.dx_m, stop.arrival.dy_m), { decimals: 1 }),
              heading: degrees(Math.abs(stop.arrival.dheading_rad)),
            })}
          </dd>
        </>
      )}
      <dt>{t("load")}</dt>
      <dd>{mass(stop.load_kg)}</dd>
      <dt>{t("order")}</dt>
      <dd>
        <Link className="inline" to={`/orders/${stop.order}`}>
          {t("show_order")}
        </Link>
      </dd>
    </dl>
  );
}
