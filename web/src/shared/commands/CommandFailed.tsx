import { useTranslation } from "react-i18next";
import type { Command } from "@/shared/ui/useCommand";
import { useWords } from "@/shared/words/useWords";
import "./CommandFailed.css";

/** Why the server did not take a command. */
export function CommandFailed({ command: { asked } }: { command: Command }) {
  const { t } = useTranslation("commands");
  const words = useWords();
  if (asked.kind !== "failed") return null;
  const request = asked.problem.requestId.slice(0, 8);
  return (
    <p className="lab failedline" role="alert">
      {t("failed", { detail: words.problem(asked.problem), request })}
    </p>
  );
}
