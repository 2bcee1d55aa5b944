import { useEffect, useRef, useState } from "react";
import { useTranslation } from "react-i18next";
import { useNow } from "@/shared/live/clock";
import { age } from "@/shared/words/format";
import "./CommandButton.css";
import { armedLeftMs, kArmMs, kHoldMs } from "./arming";
import { press, type CommandProgress, type Direction } from "./command";
import { goGuard } from "./goGuard";
import { Icon, StatusSymbol, type IconName } from "./Icon";

export interface CommandButtonProps {
  label: string;
  icon?: IconName;
  progress: CommandProgress;
  /** Why the command is not possible now; shown in the button. */
  disabledReason?: string | undefined;
  /** Sends the command, once per decision. */
  onRun: () => void;
  /** Arm, then press again within 8 s; or hold 1.5 s. Off only for what moves nothing. */
  twoStep?: boolean;
  primary?: boolean;
  direction?: Direction;
  className?: string;
}

function Ring({ part }: { part?: number }) {
  return (
    <svg viewBox="0 0 36 36" className="ring" aria-hidden="true">
      <circle className="back" cx="18" cy="18" r="15" />
      <circle
        className="hand"
        cx="18"
        cy="18"
        r="15"
        transform="rotate(-90 18 18)"
        {...(part !== undefined && { style: { strokeDashoffset: 94.2 * (1 - part) } })}
      />
    </svg>
  );
}

/**
 * Two-step command: ready, armed, requested, accepted, confirmed or timed out. Its width never changes, and a
 * double tap is one command. Enter and Space press it, Escape disarms.
 */
export function CommandButton(props: CommandButtonProps) {
  const {
    label,
    icon,
    progress,
    disabledReason,
    onRun,
    twoStep = true,
    primary = true,
    direction,
    className,
  } = props;
  const { t } = useTranslation();
  const [armedAt, setArmedAt] = useState<number>();
  const [holding, setHolding] = useState(false);
  const lastRun = useRef<number>(undefined);
  const holdTimer = useRef<ReturnType<typeof setTimeout>>(undefined);
  const heldToRun = useRef(false);
  const now = useNow(200).monoMs;
  const disabled = disabledReason !== undefined;
  const open = progress.kind === "ready" || progress.kind === "timed_out";
  const armed = armedAt !== undefined && open && !disabled;

  useEffect(() => {
    if (armedAt === undefined) return;
    const timer = setTimeout(() => setArmedAt(undefined), kArmMs);
    return () => clearTimeout(timer);
  }, [armedAt]);
  useEffect(() => {
    if (disabled || !open) setArmedAt(undefined);
  }, [disabled, open]);
  useEffect(() => () => clearTimeout(holdTimer.current), []);

  const run = () => {
    lastRun.current = performance.now();
    setArmedAt(undefined);
    onRun();
  };
  const onPress = () => {
    if (heldToRun.current) {
      heldToRun.current = false;
      return;
    }
    if (direction === "stop") goGuard.stopPressed(performance.now());
    if (disabled || (direction === "go" && !goGuard.takes(performance.now()))) return;
    const what = press(progress, armedAt, lastRun.current, performance.now(), twoStep);
    if (what.kind === "arm") setArmedAt(performance.now());
    if (what.kind === "run") run();
  };
  const endHold = () => {
    clearTimeout(holdTimer.current);
    setHolding(false);
  };
  const startHold = () => {
    if (disabled || !open || !twoStep) return;
    heldToRun.current = false;
    setHolding(true);
    holdTimer.current = setTimeout(() => {
      setHolding(false);
      heldToRun.current = true;
      if (direction === "go" && !goGuard.takes(performance.now())) return;
      run();
    }, kHoldMs);
  };

  const look = face();
  const state = disabled ? "" : holding || armed ? "armed" : look.className;
  return (
    <button
      type="button"
      className={["btn motion cmd", state, holding && "holding", className].filter(Boolean).join(" ")}
      aria-disabled={disabled}
      data-state={disabled ? "not_possible" : armed ? "armed" : progress.kind}
      onClick={onPress}
      onPointerDown={startHold}
      onPointerUp={endHold}
      onPointerLeave={endHold}
      onPointerCancel={endHold}
      onContextMenu={(event) => event.preventDefault()}
      onKeyDown={(event) => {
        if (event.key === "Escape") setArmedAt(undefined);
        if (event.repeat && (event.key === "Enter" || event.key === " ")) event.preventDefault();
      }}
    >
      {look.mark}
      <span className="t" role="status">
        <b>{look.title}</b>
        {look.small !== undefined && <small>{look.small}</small>}
      </span>
    </button>
  );

  function face() {
    if (disabled) {
      return {
        className: "",
        title: label,
        small: disabledReason,
        mark: <StatusSymbol name="c-no" className="gk" />,
      };
    }
    if (holding && !armed)
      return { className: "armed", title: label, small: t("command.hold"), mark: <Ring /> };
    if (armed) {
      const left = Math.ceil(armedLeftMs(armedAt, now) / 1000);
      return {
        className: "armed",
        title: t("command.armed"),
        small: t("command.armed_left", { label, s: left }),
        mark: <Ring />,
      };
    }
    switch (progress.kind) {
      case "ready":
        return {
          className: primary ? "primary" : "",
          title: label,
          small: undefined,
          mark: icon === undefined ? null : <Icon name={icon} />,
        };
      case "requested":
        return {
          className: "waiting",
          title: t("command.requested"),
          small: age(Math.max(0, now - progress.atMs) / 1000),
          mark: <Ring part={0.33} />,
        };
      case "accepted":
        return {
          className: "waiting",
          title: t("command.accepted"),
          small: t("command.waiting_for", { name: progress.waitingFor }),
          mark: <Ring part={0.66} />,
        };
      case "confirmed":
        return {
          className: "confirmed",
          title: t("command.confirmed"),
          small: t("command.confirmed_by", { name: progress.by, time: age(progress.afterS) }),
          mark: <StatusSymbol name="c-ok" className="gk" />,
        };
      case "under_way":
        return {
          className: "waiting",
          title: progress.title,
          small: progress.small,
          mark: <Ring part={0.66} />,
        };
      case "holds":
        return {
          className: "confirmed",
          title: progress.title,
          small: progress.small,
          mark: icon === undefined ? <StatusSymbol name="c-ok" className="gk" /> : <Icon name={icon} />,
        };
      case "timed_out":
        return {
          className: "timed-out",
          title: progress.what,
          small: progress.next,
          mark: <StatusSymbol name="a-2" className="gk" />,
        };
    }
  }
}
