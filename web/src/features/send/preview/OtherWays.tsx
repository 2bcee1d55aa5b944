import { useTranslation } from "react-i18next";
import type { LegAlternative, Plant } from "@/shared/api/types";
import { duration, length } from "@/shared/words/format";
import { passes } from "./otherWays";
import "./OtherWays.css";

/** Ways along the roadmap that were not taken, and what most speaks against each. */
export function OtherWays({ ways, plant }: { ways: readonly LegAlternative[]; plant: Plant | undefined }) {
  const { t } = useTranslation("send");
  if (ways.length === 0) return null;
  return (
    <details className="lab ways">
      <summary>{t("others.title")}</summary>
      <ul>
        {ways.map((way) => (
          <li key={way.route.join("/")}>{words(way)}</li>
        ))}
      </ul>
    </details>
  );

  function words(way: LegAlternative): string {
    const stations = passes(way, plant);
    const past = stations.length > 0 ? t("others.past", { stations: stations.join(t("words.join")) }) : "";
    const later = way.more.duration_s;
    const time = duration(Math.abs(later));
    return [
      t("others.way", { length: length(way.length_m), turns: way.turns }) + past,
      t(later >= 0.5 ? "others.later" : later <= -0.5 ? "others.sooner" : "others.same", { time }),
      t(`others.${way.main_reason}`),
    ].join(t("words.join"));
  }
}
