import { useTranslation } from "react-i18next";
import { StatusSymbol } from "@/shared/ui";
import { useWords } from "@/shared/words/useWords";
import { ArmButton } from "./ArmButton";
import { GoButton } from "./GoButton";
import type { Readiness } from "../preview/preview";
import type { Start } from "./useStart";
import "./CommandBar.css";

export interface StartBarProps {
  start: Start;
  readiness: Readiness;
  title: string;
  /** What the platform will do, in one sentence. */
  what: string;
  /** Why it cannot be started now. */
  why: string | undefined;
  /** What it will wait for once it is started. */
  waits: string | undefined;
  /** Name of the order that the vehicle ends first. */
  after: string | undefined;
}

/** Command bar: what will happen, Cancel, arm with its ring, and Start at the right. */
export function StartBar({ start, readiness, title, what, why, waits, after }: StartBarProps) {
  const { t } = useTranslation("send");
  const words = useWords();
  const { command } = start;
  const ready = readiness.kind === "ready";
  if (command.kind === "unanswered") {
    const other = command.replaces?.name;
    return (
      <div className="card confirm" role="alert">
        <Say
          warn
          title={t("start.unanswered")}
          text={t("start.ask_again_hint") + (other ? t("start.not_touched", { other }) : "")}
        />
        <button type="button" className="btn primary motion go" onClick={start.retry}>
          {t("start.ask_again")}
        </button>
      </div>
    );
  }
  if (command.kind === "refused") {
    const other = command.replaces?.name;
    const text = words.problem(command.problem);
    return (
      <div className="card confirm" role="alert">
        <Say
          warn
          title={t("start.refused")}
          text={other ? `${text}${t("say.stop")}${t("start.not_touched", { other })}` : text}
        />
        <button type="button" className="btn motion go" onClick={start.cancel}>
          {t("start.again")}
        </button>
      </div>
    );
  }
  const armed = command.kind === "armed";
  return (
    <div className="card confirm">
      <Say title={title} text={what} waits={ready ? waits : undefined} />
      {armed && (
        <button type="button" className="btn motion" onClick={start.cancel}>
          {t("start.cancel")}
        </button>
      )}
      <ArmButton start={start} ready={ready} />
      <GoButton start={start} readiness={readiness} why={why} after={after} />
    </div>
  );
}

function Say(props: { title: string; text: string; waits?: string | undefined; warn?: boolean }) {
  return (
    <div className="grow say">
      <strong>
        {props.warn && <StatusSymbol name="a-2" />} {props.title}
      </strong>
      {props.waits !== undefined && (
        <span className="waits">
          <StatusSymbol name="a-2" /> {props.waits}
        </span>
      )}
      <span className="lab">{props.text}</span>
    </div>
  );
}
