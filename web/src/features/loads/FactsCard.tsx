import { useTranslation } from "react-i18next";
import { usePlant } from "@/shared/live";
import { Card } from "@/shared/ui";
import { mass, millimetres } from "@/shared/words/format";
import { carriers } from "./places";
import { sizeOf } from "./sheet";
import type { LiveLoad } from "./useLoads";

/** What the plant knows of it. */
export function FactsCard({ load }: { load: LiveLoad }) {
  const { t } = useTranslation("loads");
  const types = usePlant().data?.vehicle_types ?? [];
  const size = sizeOf(load.outline ?? []);
  const { x_m, y_m } = load.centre ?? { x_m: 0, y_m: 0 };
  const may = carriers(load, types).map(({ name }) => name);
  const rows: [string, string][] = [
    [t("fact.id"), load.id],
    [t("fact.kind"), t(`kind.${load.kind}`)],
    [t("fact.model"), load.model ?? ""],
    [t("fact.mass"), load.mass_kg > 0 ? mass(load.mass_kg) : t("not_weighed")],
    [
      t("fact.centre"),
      x_m === 0 && y_m === 0
        ? t("centre.middle")
        : t(`centre.${x_m >= 0 ? "fore" : "aft"}_${y_m >= 0 ? "left" : "right"}`, {
            along: millimetres(Math.abs(x_m)),
            across: millimetres(Math.abs(y_m)),
          }),
    ],
    [t("fact.size"), size ? t("size", size) : t("size_unknown")],
    [t("fact.carriers"), may.length === 0 ? t("nobody") : may.join(t("join"))],
  ];
  return (
    <Card className="lfacts" title={t("fact.title")}>
      <dl className="facts">
        {rows
          .filter(([, value]) => value !== "")
          .map(([name, value]) => (
            <div key={name}>
              <dt>{name}</dt>
              <dd>{value}</dd>
            </div>
          ))}
      </dl>
    </Card>
  );
}
