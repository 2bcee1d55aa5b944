import { useTranslation } from "react-i18next";
import type { LegAlternative } from "@/shared/api/types";
import { duration, length, number } from "@/shared/words/format";
import "./OtherWays.css";

/** Ways along the roadmap that were not taken, and what most speaks against each. */
export function OtherWays({ ways }: { ways: readonly LegAlternative[] }) {
  const { t } = useTranslation("send");
  if (ways.length === 0) return null;
  return (
    <details className="lab ways">
      <summary>{t("others.title")}</summary>
      <ul>
        {ways.map((way) => (
          <li key={way.route.join("/")}>
            {t("others.way", {
              route: way.route.join(" – "),
              length: length(way.length_m),
              turns: way.turns,
            })}
            {t("words.join")}
            {t(`others.${way.main_reason}`, {
              cost: number(way.more.cost, { decimals: 0, sign: true }),
              time: duration(Math.abs(way.more.duration_s)),
            })}
          </li>
        ))}
      </ul>
    </details>
  );
}
