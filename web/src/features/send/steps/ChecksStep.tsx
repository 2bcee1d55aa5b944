import { useTranslation } from "react-i18next";
import { CheckRow, StatusSymbol } from "@/shared/ui";
import { useWords } from "@/shared/words/useWords";
import { checksSummary, checkWords } from "./checkWords";
import type { ShownCheck } from "./wayChecks";
import { useNarrow } from "@/shared/ui/useNarrow";
import { countChecks, foldChecks, makesWait, type Preview } from "../preview/preview";
import "./ChecksStep.css";

/** Checks that a person may get hurt by. */
const critical = new Set<ShownCheck["code"]>(["safety", "clearance"]);

export function ChecksStep({
  preview,
  checks,
  instead,
}: {
  preview: Preview;
  checks: readonly ShownCheck[] | undefined;
  /** Why there are no checks, when it is not that nothing has been chosen yet. */
  instead: string | undefined;
}) {
  const { t } = useTranslation("send");
  const text = useCheckText();
  const narrow = useNarrow();
  if (!checks) {
    const wait = preview.kind === "loading" ? "checks.asking" : "checks.wait";
    return <p className="lab pad-top">{instead ?? t(wait)}</p>;
  }
  const { rows, folded } = foldChecks(checks, narrow);
  const row = (check: ShownCheck) => (
    <CheckRow
      key={check.code}
      result={check.result}
      name={t(`checks.name.${check.code}`)}
      value={text(check)}
      ageS={check.age_s}
      critical={critical.has(check.code)}
      waits={makesWait(check)}
    />
  );
  return (
    <div
      className="checks"
      role="group"
      aria-label={t("checks.title")}
      tabIndex={0}
      aria-busy={preview.kind === "loading"}
    >
      {rows.map(row)}
      {folded.length > 0 && (
        <details className="folded">
          <summary>
            <StatusSymbol name="c-ok" />
            <b>{t("checks.folded", { count: folded.length })}</b>
            <span className="lab">{folded.map((c) => t(`checks.name.${c.code}`)).join(t("words.join"))}</span>
          </summary>
          {folded.map(row)}
        </details>
      )}
    </div>
  );
}

/** A check in words of the language shown. */
export function useCheckText(): (check: ShownCheck) => string {
  const { t } = useTranslation(["send", "words", "reasons", "faults"]);
  const words = useWords();
  return (check) => checkWords(check, words.names, t, words.reason);
}

/** The checks in one line, behind the sign of the worst. */
export function ChecksSummary({ checks }: { checks: readonly ShownCheck[] }) {
  const { t } = useTranslation("send");
  const { fail, wait, note } = countChecks(checks);
  return (
    <>
      {fail + wait + note > 0 && <StatusSymbol name={fail + wait > 0 ? "a-2" : "a-3"} />}{" "}
      {checksSummary(checks, (key, params) => t(key, params))}
    </>
  );
}
