import type { ReactNode } from "react";
import { useTranslation } from "react-i18next";
import "./Step.css";

export interface StepProps {
  number: number;
  title: string;
  /** The step's answer in a few words; shown when it is folded (tablets), `right` always. */
  answer?: string | undefined;
  right?: ReactNode;
  open: boolean;
  onOpen?: () => void;
  /** On tablets, closes an open step that is answered. */
  onNext?: (() => void) | undefined;
  className?: string;
  children: ReactNode;
}

/** One numbered step of the page. Below 1536 px only the open one shows its body. */
export function Step({ number, title, answer, right, open, onOpen, onNext, className, children }: StepProps) {
  const { t } = useTranslation("send");
  return (
    <section
      className={`card step s${number} ${open ? "open" : "folded"} ${className ?? ""}`}
      aria-label={title}
    >
      <header className="stp">
        <i aria-hidden="true">{number}</i>
        <h2>{title}</h2>
        {answer !== undefined && <span className="ans">{answer}</span>}
        {right !== undefined && <span className="ans r">{right}</span>}
        {onOpen && !open && (
          <button type="button" className="chg" onClick={onOpen} aria-label={`${t("change")}: ${title}`}>
            {t("change")}
          </button>
        )}
        {onNext && open && (
          <button type="button" className="nxt" onClick={onNext}>
            {t("station.next")}
          </button>
        )}
      </header>
      <div className="in body">{children}</div>
    </section>
  );
}
