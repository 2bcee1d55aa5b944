import { useCallback, useState } from "react";
import { useTranslation } from "react-i18next";
import { useMayCommand, usePlant, useServerNow } from "@/shared/live";
import { Button, Card } from "@/shared/ui";
import { dateTime, kThin, millimetres, number } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { ChangeFacts } from "./ChangeFacts";
import { isNowhere } from "./places";
import { RetireLoad } from "./RetireLoad";
import { sizeOf } from "./sheet";
import type { LiveLoad } from "./useLiveLoads";

/** What is known of it, and where a person says it anew, or that it has left for ever. */
export function FactsCard({ load }: { load: LiveLoad }) {
  const { t } = useTranslation("loads");
  const may = useMayCommand();
  const [changing, setChanging] = useState(false);
  const close = useCallback(() => setChanging(false), []);
  return (
    <Card className="lfacts" title={t("fact.title")}>
      {may && changing ? (
        <ChangeFacts id={load.id} onClose={close} />
      ) : (
        <>
          <Facts load={load} />
          {may && <Button onPress={() => setChanging(true)}>{t("form.open")}</Button>}
          {may && isNowhere(load.place) && <RetireLoad load={load} />}
        </>
      )}
    </Card>
  );
}

function Facts({ load }: { load: LiveLoad }) {
  const { t } = useTranslation("loads");
  const words = useWords();
  const now = useServerNow(60_000);
  const types = usePlant().data?.vehicle_types ?? [];
  const size = sizeOf(load.outline ?? []);
  const { mass_kg, registered_at, registered_by } = load;
  const { x_m, y_m } = load.centre;
  const may = types.filter(({ id }) => load.carriers.includes(id)).map(({ name }) => name);
  const said = [registered_by && words.actor(registered_by), registered_at && dateTime(registered_at, now)];
  const rows: [string, string][] = [
    [t("fact.id"), load.id],
    [t("fact.kind"), t(`kind.${load.kind}`)],
    [t("fact.model"), load.model ?? ""],
    [
      t("fact.mass"),
      // To the kilogram, as scales tell it: that it has been weighed anew must be seen.
      mass_kg > 0
        ? number(mass_kg, { decimals: Number.isInteger(mass_kg) ? 0 : 1 }) + kThin + "kg"
        : t("not_weighed"),
    ],
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
    [t("fact.said"), said.filter(Boolean).join(t("join"))],
  ];
  return (
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
  );
}
