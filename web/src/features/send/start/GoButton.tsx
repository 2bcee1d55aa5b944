import { useEffect, useRef } from "react";
import { useTranslation } from "react-i18next";
import { Icon } from "@/shared/ui";
import type { Readiness } from "../preview/preview";
import { kHoldMs } from "@/shared/ui/arming";
import type { Start } from "./useStart";

/** Second of the two steps, or both when it is held; where nothing can be started it says why. */
export function GoButton({
  start,
  readiness,
  why,
  after,
}: {
  start: Start;
  readiness: Readiness;
  why: string | undefined;
  /** Name of the order that the vehicle ends first. */
  after: string | undefined;
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
            <b>{t(after === undefined ? "start.start" : "start.after")}</b>
            <small className="sub">
              {after !== undefined && `${after}${t("words.join")}`}
              {armed ? t("start.second") : t("start.hold")}
            </small>
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
