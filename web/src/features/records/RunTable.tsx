import { useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import { Link } from "@/shared/router";
import { StatusSymbol } from "@/shared/ui";
import { dateTime, degrees, heading, millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import "./results.css";
import "./RunTable.css";

const two = { decimals: 2 };
const dev = { decimals: 2, sign: true };

/** The stops of one order: theoretical, actual, deviation, as Tang's Table 4. */
export function RunTable({
  run,
  current,
  now,
}: {
  run: readonly StopRecord[];
  current: string;
  now: number;
}) {
  const { t } = useTranslation("records");
  const words = useWords();
  return (
    <table className="run">
      <thead>
        <tr>
          <th>{t("col.number")}</th>
          <th>{t("col.time")}</th>
          <th className="n">{t("col.theoretical")}</th>
          <th className="n">y</th>
          <th className="n">θ</th>
          <th className="n gx">{t("col.actual")}</th>
          <th className="n">y</th>
          <th className="n">θ</th>
          <th className="n gx">dx</th>
          <th className="n">dy</th>
          <th className="n">dθ</th>
          <th>{t("col.mode")}</th>
          <th>{t("col.result")}</th>
        </tr>
      </thead>
      <tbody>
        {run.map((s) => (
          <tr
            key={s.id}
            className={s.id === current ? "on" : ""}
            aria-current={s.id === current || undefined}
          >
            <td className="b">
              {s.id === current ? (
                s.number
              ) : (
                <Link
                  className="row-link"
                  to={`/records/${s.id}`}
                  aria-label={t("open", { number: s.number, time: dateTime(s.at, now) })}
                >
                  {s.number}
                </Link>
              )}
            </td>
            <td>{dateTime(s.at, now)}</td>
            <td className="n">{millimetres(s.theoretical.x_m, two)}</td>
            <td className="n">{millimetres(s.theoretical.y_m, two)}</td>
            <td className="n">{heading(s.theoretical.heading_rad)}</td>
            <td className="n gx">{millimetres(s.measured.x_m, two)}</td>
            <td className="n">{millimetres(s.measured.y_m, two)}</td>
            <td className="n">{heading(s.measured.heading_rad)}</td>
            <td className="n b gx">{millimetres(s.dx_m, dev)}</td>
            <td className="n b">{millimetres(s.dy_m, dev)}</td>
            <td className="n b">{degrees(s.dheading_rad, { sign: true })}</td>
            <td>{words.modeShort(s.mode)}</td>
            <td className="res">
              <StatusSymbol name={s.inside ? "c-ok" : "a-2"} />
              <span>{t(s.inside ? "inside" : "outside")}</span>
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
