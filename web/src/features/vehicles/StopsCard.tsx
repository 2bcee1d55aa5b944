import { useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import { Link } from "@/shared/router";
import { Card, PanelEmpty, StatusSymbol } from "@/shared/ui";
import { dateTime, degrees, millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import "./StopsCard.css";

const kShown = 7;

/** The newest stops of one vehicle, newest first. */
export function StopsCard({ stops, now }: { stops: readonly StopRecord[]; now: number }) {
  const { t } = useTranslation("vehicles");
  const words = useWords();
  const shown = stops.slice(0, kShown);
  const first = shown[0];
  const inside = stops.filter((s) => s.inside);
  const mean = (f: (s: StopRecord) => number) => inside.reduce((sum, s) => sum + f(s), 0) / inside.length;
  return (
    <Card
      className="stops"
      scrolls
      title={t("stops.title")}
      summary={
        first &&
        t("stops.tolerance", {
          mm: millimetres(Math.min(first.tolerance.dx_m, first.tolerance.dy_m)),
          deg: degrees(first.tolerance.dheading_rad, { decimals: 1 }),
        })
      }
    >
      {shown.length === 0 ? (
        <PanelEmpty what={t("stops.empty")} when={t("stops.empty_hint")} />
      ) : (
        <>
          <table className="rows">
            <thead>
              <tr>
                <th>{t("stops.time")}</th>
                <th>{t("stops.station")}</th>
                <th className="n">dx mm</th>
                <th className="n">dy mm</th>
                <th className="n">dθ °</th>
                <th>{t("stops.mode")}</th>
                <th>
                  <span className="sr-only">{t("stops.result")}</span>
                </th>
              </tr>
            </thead>
            <tbody>
              {shown.map((s) => (
                <tr key={s.id}>
                  <td>
                    <Link className="cell-link" to={`/records/${s.id}`}>
                      {dateTime(s.at, now)}
                    </Link>
                  </td>
                  <td className="b" data-label={t("stops.station")}>
                    {s.number}
                  </td>
                  <td className="n" data-label="dx mm">
                    {millimetres(s.dx_m, { decimals: 2, sign: true })}
                  </td>
                  <td className="n" data-label="dy mm">
                    {millimetres(s.dy_m, { decimals: 2, sign: true })}
                  </td>
                  <td className="n" data-label="dθ °">
                    {degrees(s.dheading_rad, { sign: true })}
                  </td>
                  <td>{words.modeShort(s.mode)}</td>
                  <td>
                    <StatusSymbol name={s.inside ? "c-ok" : "a-2"} />
                    <span className="sr-only">{t(s.inside ? "stops.inside" : "stops.outside")}</span>
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
          {inside.length > 1 && (
            <p className="cap sumr">
              {t("stops.summary", {
                count: inside.length,
                mm: millimetres(
                  mean((s) => Math.hypot(s.dx_m, s.dy_m)),
                  { decimals: 1 },
                ),
                deg: degrees(mean((s) => Math.abs(s.dheading_rad))),
              })}
            </p>
          )}
        </>
      )}
    </Card>
  );
}
