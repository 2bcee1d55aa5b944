import { useState } from "react";
import { useTranslation } from "react-i18next";
import { Card, StatusSymbol } from "@/shared/ui";
import { dateTime, degrees, fixed, millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { shownFixes, type Fix } from "./shownFixes";
import "./FixesCard.css";

const kShown = 3;
const symbols = { taken: "c-ok", agreed: "c-ok", refused: "a-2", begun_anew: "a-3" } as const;

/** What its senses said of its place last and what the vehicle made of it, newest first. */
export function FixesCard({ fixes, now }: { fixes: readonly Fix[]; now: number }) {
  const { t } = useTranslation("vehicles");
  const words = useWords();
  const [all, setAll] = useState(false);
  if (fixes.length === 0) return null;
  return (
    <Card
      className="fixes"
      title={t("fixes.title")}
      summary={t("fixes.summary")}
      right={
        fixes.length > kShown && (
          <button type="button" className="btn" aria-expanded={all} onClick={() => setAll(!all)}>
            {t(all ? "fixes.fewer" : "fixes.all", { count: fixes.length })}
          </button>
        )
      }
    >
      <table className="rows">
        <thead>
          <tr>
            <th>{t("fixes.time")}</th>
            <th>{t("fixes.by")}</th>
            <th>{t("fixes.result")}</th>
            <th className="n">{t("fixes.moved")}</th>
            <th className="n">{t("fixes.turned")}</th>
            <th className="n">{t("fixes.times")}</th>
          </tr>
        </thead>
        <tbody>
          {(all ? fixes : shownFixes(fixes, kShown)).map((fix) => (
            <tr key={`${fix.by} ${fix.code} ${fix.result} ${fix.why} ${fix.at}`} data-fix={fix.result}>
              <td>{dateTime(fix.at, now)}</td>
              <td className="b">{t(`fixes.source.${fix.by}`, { code: fix.code })}</td>
              <td>
                <StatusSymbol name={symbols[fix.result]} />{" "}
                {t(`fixes.${fix.result}`, {
                  why: fix.why === undefined ? "" : words.reason({ code: fix.why, params: {} }),
                })}
              </td>
              <td className="n" data-label={t("fixes.moved")}>
                {millimetres(fix.moved_m, { decimals: 1 })}
              </td>
              <td className="n" data-label={t("fixes.turned")}>
                {degrees(fix.turned_rad)}
              </td>
              <td className="n" data-label={t("fixes.times")}>
                {fixed(fix.times, 0)}
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </Card>
  );
}
