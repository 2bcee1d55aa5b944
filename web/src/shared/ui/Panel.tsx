import { useEffect, useState, type ReactNode } from "react";
import { useTranslation } from "react-i18next";
import { ApiProblem } from "@/shared/api/problem";
import { problemText } from "@/shared/words/reasons";
import { Button } from "./Button";
import { StatusSymbol } from "./Icon";
import "./Panel.css";

/** Grey shapes of the answer, from 300 ms on. No spinner. */
export function PanelLoading({ what }: { what: string }) {
  const { t } = useTranslation();
  const [shown, setShown] = useState(false);
  useEffect(() => {
    const timer = setTimeout(() => setShown(true), 300);
    return () => clearTimeout(timer);
  }, []);
  return (
    <div className="pin" aria-busy="true" aria-label={t("panel.loading", { what })}>
      {shown && (
        <>
          <div className="sk" />
          <div className="sk s2" />
          <div className="sk" />
          <div className="sk s3" />
        </>
      )}
    </div>
  );
}

/** What failed, with the request id; that nothing was changed; and a way to try again. */
export function PanelFailed({
  what,
  error,
  onRetry,
}: {
  what: string;
  error: unknown;
  onRetry?: () => void;
}) {
  const { t } = useTranslation();
  const problem =
    error instanceof ApiProblem ? error : new ApiProblem({ status: 0, code: "unexpected_answer" });
  return (
    <div className="pin" role="alert">
      <StatusSymbol name="a-2" size={44} />
      <b>{what}</b>
      <span className="lab">
        {problemText(problem, t)}{" "}
        {problem.requestId !== "" && t("panel.request", { id: problem.requestId.slice(0, 8) })}{" "}
        {t("panel.nothing_changed")}
      </span>
      {onRetry && <Button onPress={onRetry}>{t("panel.retry")}</Button>}
    </div>
  );
}

/** What would be here, and when. */
export function PanelEmpty({ what, when, action }: { what: string; when?: string; action?: ReactNode }) {
  return (
    <div className="pin">
      <svg className="big" viewBox="0 0 48 48" aria-hidden="true">
        <path d="M8 18V8H18M30 8H40V18M40 30V40H30M18 40H8V30" />
      </svg>
      <b>{what}</b>
      {when !== undefined && <span className="lab">{when}</span>}
      {action}
    </div>
  );
}
