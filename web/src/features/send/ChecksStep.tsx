import { useTranslation } from "react-i18next";
import type { Check } from "@/shared/api/types";
import { CheckRow } from "@/shared/ui";
import { useTemplates, useWords } from "@/shared/words/useWords";
import { checkWords } from "./checkWords";
import { countChecks, sortChecks, type Preview } from "./preview";

/** Checks that a person may get hurt by. */
const critical = new Set<Check["code"]>(["safety", "clearance"]);

export function ChecksStep({
  preview,
  checks,
  instead,
}: {
  preview: Preview;
  checks: readonly Check[] | undefined;
  /** Why there are no checks, when it is not that nothing has been chosen yet. */
  instead: string | undefined;
}) {
  const { t } = useTranslation("send");
  const text = useCheckText();
  if (!checks) {
    const wait = preview.kind === "loading" ? "checks.asking" : "checks.wait";
    return <p className="lab pad-top">{instead ?? t(wait)}</p>;
  }
  return (
    <div
      className="checks"
      role="group"
      aria-label={t("checks.title")}
      tabIndex={0}
      aria-busy={preview.kind === "loading"}
    >
      {sortChecks(checks).map((check) => (
        <CheckRow
          key={check.code}
          result={check.result}
          name={t(`checks.name.${check.code}`)}
          value={text(check)}
          ageS={check.age_s}
          critical={critical.has(check.code)}
        />
      ))}
    </div>
  );
}

/** A check in words of the language shown. */
export function useCheckText(): (check: Check) => string {
  const template = useTemplates("send");
  const words = useWords();
  return (check) => {
    const { fault } = check.params;
    const params = typeof fault === "string" ? { ...check.params, fault: words.fault(fault) } : check.params;
    return checkWords({ ...check, params }, words.names, template, words.reason);
  };
}

/** "9 of 9 pass, 1 note" */
export function useChecksSummary(): (checks: readonly Check[] | undefined) => string | undefined {
  const { t } = useTranslation("send");
  return (checks) => {
    if (!checks) return undefined;
    const { pass, note, fail, total } = countChecks(checks);
    if (fail > 0) return t("checks.summary_fail", { fail, total });
    if (note === 0) return t("checks.summary", { pass, total });
    return t(note === 1 ? "checks.summary_note_one" : "checks.summary_note_other", { pass, total, note });
  };
}
