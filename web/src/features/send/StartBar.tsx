import { useEffect, useRef } from "react";
import { useTranslation } from "react-i18next";
import { Link } from "@/shared/router";
import { Icon, StatusSymbol } from "@/shared/ui";
import { useWords } from "@/shared/words/useWords";
import type { Readiness } from "./preview";
import { armedLeft_s, kArmMs, kHoldMs } from "./startCommand";
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
}

/** Command bar: what will happen, Cancel, arm with its ring, and Start at the right. */
export function StartBar({ start, readiness, title, what, why }: StartBarProps) {
  const { t } = useTranslation("send");
  const words = useWords();
  const { command } = start;
  const ready = readiness.kind === "ready";
  if (command.kind === "unanswered") {
    return (
      <div className="card confirm" role="alert">
        <Say symbol="a-2" title={t("start.unanswered")} text={t("start.ask_again_hint")} />
        <button type="button" className="btn primary motion go" onClick={start.retry}>
          {t("start.ask_again")}
        </button>
      </div>
    );
  }
  if (command.kind === "refused") {
    return (
      <div className="card confirm" role="alert">
        <Say symbol="a-2" title={t("start.refused")} text={words.problem(command.problem)} />
        <button type="button" className="btn motion go" onClick={start.cancel}>
          {t("start.again")}
        </button>
      </div>
    );
  }
  const armed = command.kind === "armed";
  return (
    <div className="card confirm">
      <Say title={title} text={what} />
      {readiness.kind === "on_its_way" && readiness.order !== undefined && (
        <Link className="btn motion" to={`/orders/${readiness.order}`}>
          {t("move.to_order")}
        </Link>
      )}
      {armed && (
        <button type="button" className="btn motion" onClick={start.cancel}>
          {t("start.cancel")}
        </button>
      )}
      <ArmButton start={start} ready={ready} />
      <GoButton start={start} readiness={readiness} why={why} />
    </div>
  );
}

function Say({ title, text, symbol }: { title: string; text: string; symbol?: "a-2" }) {
  return (
    <div className="grow say">
      <strong>
        {symbol && <StatusSymbol name={symbol} />} {title}
      </strong>
      <span className="lab">{text}</span>
    </div>
  );
}

function ArmButton({ start, ready }: { start: Start; ready: boolean }) {
  const { t } = useTranslation("send");
  const armed = start.command.kind === "armed";
  const left = armedLeft_s(start.command, start.nowMs);
  const share = (left * 1000) / kArmMs;
  return (
    <button
      type="button"
      className={`btn motion armed ${armed ? "is-armed" : ""}`}
      aria-disabled={!ready || start.command.kind === "requested"}
      onClick={() => ready && start.arm()}
    >
      <svg viewBox="0 0 36 36" className="ring" aria-hidden="true">
        <circle cx="18" cy="18" r="15" stroke="var(--rule-2)" />
        {!armed && (
          <text x="18" y="23" textAnchor="middle">
            1
          </text>
        )}
        {armed && (
          <circle
            cx="18"
            cy="18"
            r="15"
            stroke="var(--ink)"
            strokeDasharray={`${94.2 * share} 94.2`}
            transform="rotate(-90 18 18)"
          />
        )}
      </svg>
      <span>
        {armed && <small>1 {t("start.armed")}</small>}
        <b>{armed ? t("start.left", { seconds: Math.ceil(left) }) : t("start.arm")}</b>
      </span>
    </button>
  );
}

function GoButton({
  start,
  readiness,
  why,
}: {
  start: Start;
  readiness: Readiness;
  why: string | undefined;
}) {
  const { t } = useTranslation("send");
  const button = useRef<HTMLButtonElement>(null);
  const holding = useRef<ReturnType<typeof setTimeout>>(undefined);
  const held = useRef(false);
  const { command } = start;
  const ready = readiness.kind === "ready";
  const armed = command.kind === "armed";
  const requested = command.kind === "requested";

  // Enter, Enter: arming moves the focus here.
  useEffect(() => {
    if (armed) button.current?.focus({ preventScroll: true });
  }, [armed]);
  useEffect(() => () => clearTimeout(holding.current), []);

  const endHold = () => clearTimeout(holding.current);
  const beginHold = () => {
    held.current = false;
    if (!ready || requested) return;
    holding.current = setTimeout(() => {
      held.current = true;
      start.hold();
    }, kHoldMs);
  };
  const press = () => {
    if (held.current) {
      held.current = false;
      return;
    }
    if (requested) return;
    if (armed) start.start();
    else if (ready) start.arm();
  };
  const seconds = requested ? ((start.nowMs - command.sinceMs) / 1000).toFixed(1) : "";
  return (
    <button
      ref={button}
      type="button"
      className={`btn motion go ${ready ? "primary" : ""} ${requested ? "wait" : ""}`}
      aria-disabled={!ready || requested}
      data-state={requested ? "requested" : armed ? "armed" : ready ? "ready" : readiness.kind}
      onClick={press}
      onPointerDown={beginHold}
      onPointerUp={endHold}
      onPointerLeave={endHold}
      onPointerCancel={endHold}
      onContextMenu={(event) => event.preventDefault()}
      onKeyDown={(event) => {
        if (event.key === "Escape") start.cancel();
        if (event.repeat && (event.key === "Enter" || event.key === " ")) event.preventDefault();
      }}
    >
      {requested ? (
        <span className="two" role="status">
          <b>{t("start.requested")}</b>
          <small className="sub">{t("start.requested_for", { seconds })}</small>
        </span>
      ) : ready ? (
        <>
          <small className="no" aria-hidden="true">
            2
          </small>
          <span className="two">
            <b>{t("start.start")}</b>
            <small className="sub">{armed ? t("start.second") : t("start.hold")}</small>
          </span>
          <Icon name="right" />
        </>
      ) : (
        <span className="two">
          <b className="why">{why}</b>
        </span>
      )}
    </button>
  );
}
