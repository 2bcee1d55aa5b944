import type { ReactNode } from "react";
import { useTranslation } from "react-i18next";
import type { Vehicle, VehicleType } from "@/shared/api/types";
import { StatusSymbol } from "@/shared/ui";
import { fixed, millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { DrivePad } from "./DrivePad";
import { HoldButton } from "./HoldButton";
import type { HandHeld, HandState } from "./handHeld";
import { goesSideways, isStill, kShares, kTurn_radps, kWalk_mps } from "./twist";
import "./DriveDesk.css";

/** What two thumbs drive with: the hold at the left, the ways at the right, the speed and what is done between them. */
export function DriveDesk({
  control,
  state,
  vehicle,
  type,
  children,
}: {
  control: HandHeld;
  state: HandState;
  vehicle: Vehicle;
  type: VehicleType | undefined;
  /** What whoever drives looks at, where there is room for it. */
  children?: ReactNode;
}) {
  const { t } = useTranslation("drive");
  const words = useWords();
  const moves = !isStill(control.wanted());
  const refused = state.refused;
  const alarming = state.line === "cut" || state.slow || refused !== undefined;
  return (
    <section className="card desk" aria-label={t("desk.label")} data-mine={state.mine}>
      <HoldButton
        className="dead"
        label={t("hold.label")}
        shortcuts="Space"
        down={state.held}
        disabled={!state.mine}
        onDown={(down) => control.hold(down)}
      >
        <b>{t(state.held ? "hold.held" : "hold.press")}</b>
        <small>{t("hold.key")}</small>
      </HoldButton>
      {children}
      <div className="mid">
        <p className={`says ${alarming ? "bad" : ""}`} role="status">
          <StatusSymbol name={alarming ? "a-2" : moves ? "s-moving" : "s-stand"} />
          <b>{doing()}</b>
        </p>
        <div className="seg speed" role="group" aria-label={t("speed.label")}>
          {kShares.map((share, i) => (
            <button
              key={share}
              type="button"
              aria-pressed={state.share === share}
              aria-keyshortcuts={String(i + 1)}
              onClick={() => control.setShare(share)}
            >
              <b>{t(`speed.${i}`)}</b>
              <small>
                {t("speed.value", {
                  speed: millimetres(share * kWalk_mps),
                  turn: fixed((share * kTurn_radps * 180) / Math.PI, 1),
                })}
              </small>
            </button>
          ))}
        </div>
        <p className="lab keys">{t(goesSideways(type) ? "keys" : "keys_ahead")}</p>
      </div>
      <DrivePad control={control} state={state} sideways={goesSideways(type)} />
    </section>
  );

  function doing(): string {
    if (state.line === "cut") return t("does.cut", { vehicle: vehicle.name });
    if (state.line === "connecting") return t("does.connecting");
    if (state.slow) return t("does.slow", { vehicle: vehicle.name });
    if (refused !== undefined) return words.reason(refused);
    if (!state.mine) return t("does.not_mine");
    if (moves) return t("does.moves");
    if (!state.standing) return t("does.brakes");
    return t(state.held ? "does.choose" : "does.stands");
  }
}
