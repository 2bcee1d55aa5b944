import type { ReactNode } from "react";
import { useTranslation } from "react-i18next";
import { StatusSymbol, type SymbolName } from "./Icon";
import "./Banner.css";

/** `held`: no alarm, but a state that a person has made and that a person ends. */
export type Priority = "critical" | "high" | "low" | "held";
export const prioritySymbol: Record<Priority, SymbolName> = {
  critical: "a-1",
  high: "a-2s",
  low: "a-3",
  held: "s-wait",
};

export interface BannerProps {
  priority: Priority;
  what: ReactNode;
  todo?: ReactNode;
  age?: string | undefined;
  actions?: ReactNode;
  /** Word in the coloured block; the priority by default. */
  word?: string;
  /** A sentence that a press follows, and no second one: at most three lines on a phone. */
  brief?: boolean;
}

/** The most urgent thing only, always at the same place: top of the page. */
export function Banner({ priority, what, todo, age, actions, word, brief }: BannerProps) {
  const { t } = useTranslation();
  return (
    <div
      className={`banner ${priority} ${brief ? "brief" : ""}`}
      role={priority === "held" ? "status" : "alert"}
    >
      <div className="pri">
        <StatusSymbol name={prioritySymbol[priority]} />
        <span>{word ?? t(`priority.${priority}`)}</span>
      </div>
      <div className="txt">
        <span>{what}</span>
        {todo !== undefined && <span className="lab">{todo}</span>}
      </div>
      {age !== undefined && <span className="age">{age}</span>}
      {actions !== undefined && <div className="acts">{actions}</div>}
    </div>
  );
}
