import { useCallback, useEffect, useMemo, useState } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { LiftCommand, Vehicle, VehicleType } from "@/shared/api/types";
import { CommandFailed } from "@/shared/commands";
import { feetDown } from "@/shared/live/feet";
import { CommandButton } from "@/shared/ui";
import type { CommandProgress } from "@/shared/ui/command";
import { useCommand, useProgress, type Command } from "@/shared/ui/useCommand";
import { millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { bracketKey } from "./drawing/faceplate";
import { heights, kAllBrackets, liftBar, readHeight, reasonOf } from "./lifts";
import "./IntegrationCard.css";
import "./LiftsCard.css";

interface Props {
  vehicle: Vehicle;
  type: VehicleType | undefined;
  /** Why commands are off. */
  refused: string | undefined;
}

/** Brackets and parking feet outside an order: one movement at a time, held with one press by anybody. */
export function LiftsCard({ vehicle, type, refused }: Props) {
  const { t } = useTranslation("vehicles");
  const words = useWords();
  const { id, lift } = vehicle;
  const hold = useCommand(
    useCallback(() => call(api.POST("/api/v1/vehicles/{id}/lifts/stop", { params: { path: { id } } })), [id]),
  );
  const holding = useProgress(hold, lift?.state !== "under_way", vehicle.name);
  const hasBrackets = (type?.brackets.length ?? 0) > 0;
  const hasFeet = vehicle.parking_feet.length > 0;
  if (!hasBrackets && !hasFeet) return null;

  const height = heights(vehicle.brackets);
  const now: string[] = [];
  if (height) {
    const low = millimetres(height.low_m, { decimals: 1 });
    const high = millimetres(height.high_m, { decimals: 1 });
    now.push(low === high ? t("lifts.level", { height: low }) : t("lifts.uneven", { low, high }));
  }
  if (hasFeet) now.push(t(feetDown(vehicle.parking_feet) ? "loads.feet_lowered" : "loads.feet_raised"));
  return (
    <details className="card integ lifts" open={lift !== undefined}>
      <summary>
        <b>{t(hasBrackets ? (hasFeet ? "lifts.title" : "lifts.title_brackets") : "lifts.title_feet")}</b>
        <span className="lab">{now.join(t("join"))}</span>
      </summary>
      {hasBrackets && <BracketLift vehicle={vehicle} type={type} refused={refused} />}
      {hasFeet && <FootLift vehicle={vehicle} type={type} refused={refused} />}
      {lift?.state === "failed" && (
        <p className="failed" role="status">
          {t("lifts.failed", { why: words.reason(reasonOf(lift.why ?? "")) })}
        </p>
      )}
      <CommandFailed command={hold} />
      <CommandButton
        className="hold"
        label={t("lifts.hold")}
        icon="pause"
        primary={false}
        twoStep={false}
        direction="stop"
        progress={holding}
        disabledReason={refused}
        onRun={hold.run}
      />
    </details>
  );
}

/** Which bracket, how high, and the button. */
function BracketLift({ vehicle, type, refused }: Props) {
  const { t } = useTranslation("vehicles");
  const [bracket, setBracket] = useState(kAllBrackets);
  const [text, setText] = useState("");
  const stroke_m = type?.bracket_lift?.stroke_m ?? 0;
  const draft = readHeight(text, stroke_m);
  const height_m = draft.kind === "height" ? draft.height_m : undefined;
  const body = useMemo<LiftCommand | undefined>(
    () => (height_m === undefined ? undefined : { type: "setBracketHeight", bracket, height_m }),
    [bracket, height_m],
  );
  const { command, progress } = useLift(vehicle, "setBracketHeight", body);
  const bar = liftBar(vehicle, "setBracketHeight");
  const choice = (name: string, label: string) => (
    <button key={name} type="button" aria-pressed={bracket === name} onClick={() => setBracket(name)}>
      {label}
    </button>
  );
  return (
    <>
      <div className="seg" role="group" aria-label={t("lifts.which")}>
        {choice(kAllBrackets, t("lifts.all"))}
        {(type?.brackets ?? []).map((b) =>
          choice(b.name, t(`loads.bracket.${bracketKey(type, b.name)}`, { defaultValue: b.name })),
        )}
      </div>
      <div className="fields">
        <label className="field">
          <span className="cap">{t("lifts.height")}</span>
          <input
            type="text"
            inputMode="decimal"
            value={text}
            onChange={(event) => setText(event.target.value)}
          />
        </label>
        <CommandButton
          label={
            height_m === undefined
              ? t("lifts.move")
              : t("lifts.move_to", { height: millimetres(height_m, { decimals: 1 }) })
          }
          primary={false}
          direction="go"
          progress={progress}
          disabledReason={
            refused ??
            (bar === undefined ? undefined : t(`lifts.${bar}`)) ??
            (draft.kind === "height" ? undefined : t(`lifts.${draft.kind}`, { most: millimetres(stroke_m) }))
          }
          onRun={command.run}
        />
      </div>
      <CommandFailed command={command} />
    </>
  );
}

const kLower: LiftCommand = { type: "lowerParking" };
const kRaise: LiftCommand = { type: "raiseParking" };

/** All feet down until they carry, or up. */
function FootLift({ vehicle, refused }: Props) {
  const { t } = useTranslation("vehicles");
  const lower = useLift(vehicle, kLower.type, kLower);
  const raise = useLift(vehicle, kRaise.type, kRaise);
  const button = (label: string, type: LiftCommand["type"], { command, progress }: Lift) => {
    const bar = liftBar(vehicle, type);
    return (
      <CommandButton
        label={label}
        primary={false}
        direction="go"
        progress={progress}
        disabledReason={refused ?? (bar === undefined ? undefined : t(`lifts.${bar}`))}
        onRun={command.run}
      />
    );
  };
  return (
    <>
      <div className="feet">
        {button(t("lifts.lower"), kLower.type, lower)}
        {button(t("lifts.raise"), kRaise.type, raise)}
      </div>
      <CommandFailed command={lower.command} />
      <CommandFailed command={raise.command} />
    </>
  );
}

interface Lift {
  command: Command;
  progress: CommandProgress;
}

/** A movement as it is asked for here, and how far it is, whoever asked. */
function useLift(vehicle: Vehicle, type: LiftCommand["type"], body: LiftCommand | undefined): Lift {
  const { t } = useTranslation("vehicles");
  const words = useWords();
  const [asked, setAsked] = useState<string>();
  const command = useCommand(
    useCallback(async () => {
      if (body === undefined) return;
      const path = { id: vehicle.id };
      const taken = await call(api.POST("/api/v1/vehicles/{id}/lifts", { params: { path }, body }));
      setAsked(taken.lift?.action_id);
    }, [vehicle.id, body]),
  );
  const { lift } = vehicle;
  const ended = lift !== undefined && lift.action_id === asked ? lift.state : undefined;
  const own = useProgress(command, ended === "done", vehicle.name);
  const { reset } = command;
  useEffect(() => {
    if (ended === "failed") reset(); // why stands below
  }, [ended, reset]);
  if (lift?.state !== "under_way" || lift.type !== type) return { command, progress: own };
  const small = t("lifts.for", { actor: words.actor(lift.by) });
  return { command, progress: { kind: "under_way", title: t("lifts.moves"), small } };
}
