import { useTranslation } from "react-i18next";
import type { Point } from "@/shared/api/types";
import { usePlant, useVehicle } from "@/shared/live";
import { Card } from "@/shared/ui";
import { length } from "@/shared/words/format";
import { sheetOf } from "./sheet";
import type { LiveLoad } from "./useLiveLoads";

const ring = (points: readonly Point[]) => points.map((p) => `${p.x_m},${-p.y_m}`).join(" ");

/** Outline and centre of gravity from above, to scale, over the brackets and the body of the vehicle that carries it. */
export function LoadDrawing({ load }: { load: LiveLoad }) {
  const { t } = useTranslation("loads");
  const types = usePlant().data?.vehicle_types ?? [];
  const carrier = useVehicle(load.place.vehicle);
  const type =
    types.find(({ id }) => id === carrier?.type) ?? types.find(({ id }) => load.carriers.includes(id));
  const sheet = sheetOf(load, type);
  const { box, centre, scale_m } = sheet;
  const arm = 0.028 * box.width;
  const below = box.top + box.height - 0.035 * box.width;
  const right = box.left + box.width * 0.97;
  return (
    <Card
      className="lplan"
      title={t("drawing.title")}
      {...(type && { summary: t(sheet.usual ? "drawing.usual" : "drawing.on", { type: type.name }) })}
      flush
    >
      <div className="mapbox lpaper">
        <svg
          className="m"
          viewBox={`${box.left} ${box.top} ${box.width} ${box.height}`}
          role="img"
          aria-label={t("drawing.label", { load: load.name })}
        >
          {sheet.body.length > 0 && <polygon className="lbody" points={ring(sheet.body)} />}
          <polygon className={`load ${sheet.usual ? "lusual" : ""}`} points={ring(sheet.outline)} />
          {sheet.allowed.length > 0 && <polygon className="lallowed" points={ring(sheet.allowed)} />}
          {sheet.brackets.map((p) => (
            <rect
              key={`${p.x_m} ${p.y_m}`}
              className="lbracket"
              x={p.x_m - 0.25}
              y={-p.y_m - 0.15}
              width=".5"
              height=".3"
            />
          ))}
          <path
            className="lcross"
            d={`M${centre.x_m - arm} ${-centre.y_m}h${2 * arm}M${centre.x_m} ${-centre.y_m - arm}v${2 * arm}`}
          />
          <circle className="lcentre" cx={centre.x_m} cy={-centre.y_m} r={arm * 0.4} />
          <path
            className="lscale"
            d={`M${right - scale_m} ${below}v${-arm / 2}v${arm}v${-arm / 2}h${scale_m}v${-arm / 2}v${arm}`}
          />
        </svg>
      </div>
      <ul className="lkey">
        <li>
          <i className="lk-centre" />
          {t("key.centre")}
        </li>
        {sheet.brackets.length > 0 && (
          <li>
            <i className="lk-bracket" />
            {t("key.brackets")}
          </li>
        )}
        {sheet.allowed.length > 0 && (
          <li>
            <i className="lk-allowed" />
            {t("key.allowed")}
          </li>
        )}
        {sheet.body.length > 0 && (
          <li>
            <i className="lk-body" />
            {t("key.body")}
          </li>
        )}
        <li>
          <i className="lk-scale" />
          {length(scale_m)}
        </li>
      </ul>
    </Card>
  );
}
