import { useCallback, useMemo, useState } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { LiftCommand, Vehicle, VehicleType } from "@/shared/api/types";
import { CommandFailed } from "@/shared/commands";
import { feetDown } from "@/shared/live/feet";
import { CommandButton } from "@/shared/ui";
import { useCommand, useProgress } from "@/shared/ui/useCommand";
import { millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { BracketChoice } from "./BracketChoice";
import { Choice } from "./Choice";
import { footCorner } from "./drawing/faceplate";
import { heights, kAll, liftBar, readHeight, readSpeed, reasonOf } from "./lifts";
import { LoadTransfer } from "./LoadTransfer";
import { PlaceLoad } from "./PlaceLoad";
import { useLift, type Lift } from "./useLift";
import "@/shared/ui/folded.css";
import "./LiftsCard.css";

interface Props {
  vehicle: Vehicle;
  type: VehicleType | undefined;
  /** Why commands are off. */
  refused: string | undefined;
}
type CardProps = Props & {
  /** Unfolded from the beginning: where nothing else is to be seen. */
  open?: boolean;
};

/** Brackets and parking feet outside an order: one movement at a time, held with one press by anybody. */
export function LiftsCard({ vehicle, type, refused, open = false }: CardProps) {
  const { t } = useTranslation("body");
  const words = useWords();
  const { id, lift } = vehicle;
  const hold = useCommand(
    useCallback(() => call(api.POST("/api/v1/vehicles/{id}/lifts/stop", { params: { path: { id } } })), [id]),
  );
  const holding = useProgress(hold, lift?.state !== "under_way", vehicle.name);
  const [opened, setOpened] = useState(open);
  const asks = lift !== undefined || vehicle.load_fault !== undefined;
  if (asks && !opened) setOpened(true); // and stays so when that is over
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
    <details className="card integ lifts" open={opened}>
      <summary>
        <b>{t(hasBrackets ? (hasFeet ? "lifts.title" : "lifts.title_brackets") : "lifts.title_feet")}</b>
        <span className="lab">{now.join(t("join"))}</span>
      </summary>
      {hasBrackets && <PlaceLoad vehicle={vehicle} refused={refused} />}
      {hasBrackets && <LoadTransfer vehicle={vehicle} refused={refused} />}
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

/** Which bracket, how high, how fast, and the button. */
function BracketLift({ vehicle, type, refused }: Props) {
  const { t } = useTranslation("body");
  const [bracket, setBracket] = useState(kAll);
  const [text, setText] = useState("");
  const [speedText, setSpeedText] = useState("");
  const stroke_m = type?.bracket_lift?.stroke_m ?? 0;
  const most_mps = type?.bracket_lift?.speed_mps ?? 0;
  const draft = readHeight(text, stroke_m);
  const speed = readSpeed(speedText, most_mps);
  const height_m = draft.kind === "height" && speed.kind !== "bad_speed" ? draft.height_m : undefined;
  const speed_mps = speed.kind === "speed" ? speed.speed_mps : undefined;
  const body = useMemo<LiftCommand | undefined>(
    () =>
      height_m === undefined
        ? undefined
        : {
            type: "setBracketHeight",
            bracket,
            height_m,
            ...(speed_mps !== undefined && { speed_mps }),
          },
    [bracket, height_m, speed_mps],
  );
  const { command, progress } = useLift(vehicle, "setBracketHeight", body);
  const bar = liftBar(vehicle, "setBracketHeight");
  const wrong =
    draft.kind !== "height"
      ? t(`lifts.${draft.kind}`, { most: millimetres(stroke_m) })
      : speed.kind === "bad_speed"
        ? t("lifts.bad_speed", { most: millimetres(most_mps) })
        : undefined;
  const field = (label: string, value: string, onChange: (text: string) => void, placeholder?: string) => (
    <label className="field">
      <span className="cap">{label}</span>
      <input
        type="text"
        inputMode="decimal"
        value={value}
        placeholder={placeholder}
        onChange={(event) => onChange(event.target.value)}
      />
    </label>
  );
  return (
    <>
      <BracketChoice
        type={type}
        names={(type?.brackets ?? []).map((b) => b.name)}
        chosen={bracket}
        onChoose={setBracket}
      />
      <div className="fields">
        {field(t("lifts.height"), text, setText)}
        {field(t("lifts.speed"), speedText, setSpeedText, millimetres(most_mps))}
        <CommandButton
          label={
            height_m === undefined
              ? t("lifts.move")
              : t("lifts.move_to", { height: millimetres(height_m, { decimals: 1 }) })
          }
          primary={false}
          direction="go"
          progress={progress}
          disabledReason={refused ?? (bar === undefined ? undefined : t(`lifts.${bar}`)) ?? wrong}
          onRun={command.run}
        />
      </div>
      <CommandFailed command={command} />
    </>
  );
}

/** All feet down until they carry, or up; or one alone. */
function FootLift({ vehicle, refused }: Props) {
  const { t } = useTranslation("body");
  const [foot, setFoot] = useState(kAll);
  const one = foot === kAll ? undefined : foot;
  const lower = useFeet(vehicle, "lowerParking", one);
  const raise = useFeet(vehicle, "raiseParking", one);
  const button = (what: "lower" | "raise", type: LiftCommand["type"], { command, progress }: Lift) => {
    const bar = liftBar(vehicle, type);
    return (
      <CommandButton
        label={t(one === undefined ? `lifts.${what}` : `lifts.${what}_one`)}
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
      <Choice
        label={t("lifts.which_foot")}
        all={t("lifts.all_feet")}
        names={vehicle.parking_feet.map((f, index) => {
          const { x, y } = footCorner(f.name, index);
          const corner = `${x > 0 ? "front" : "back"}_${y > 0 ? "left" : "right"}`;
          return { name: f.name, label: t(`loads.bracket.${corner}`) };
        })}
        chosen={foot}
        onChoose={setFoot}
      />
      <div className="feet">
        {button("lower", "lowerParking", lower)}
        {button("raise", "raiseParking", raise)}
      </div>
      <CommandFailed command={lower.command} />
      <CommandFailed command={raise.command} />
    </>
  );
}

function useFeet(vehicle: Vehicle, type: "lowerParking" | "raiseParking", foot: string | undefined): Lift {
  const body = useMemo<LiftCommand>(() => ({ type, ...(foot !== undefined && { foot }) }), [type, foot]);
  return useLift(vehicle, type, body);
}
