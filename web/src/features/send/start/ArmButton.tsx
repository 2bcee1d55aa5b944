import { useTranslation } from "react-i18next";
import { kArmMs } from "@/shared/ui/arming";
import { armedLeft_s } from "./startCommand";
import type { Start } from "./useStart";

/** First of the two steps, with a ring that drains while Start counts. */
export function ArmButton({ start, ready }: { start: Start; ready: boolean }) {
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
