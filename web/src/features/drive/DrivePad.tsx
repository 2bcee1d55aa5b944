import { useTranslation } from "react-i18next";
import { HoldButton } from "./HoldButton";
import type { HandHeld, HandState } from "./handHeld";
import type { Direction } from "./twist";
import "./DrivePad.css";

interface Key {
  name: string;
  directions: readonly Direction[];
  /** Where its arrow points, counter-clockwise from ahead, in degrees. */
  angle: number;
  keys: string;
}

const kWay: readonly (Key | undefined)[] = [
  { name: "ahead_left", directions: ["ahead", "left"], angle: 45, keys: "ArrowUp+ArrowLeft" },
  { name: "ahead", directions: ["ahead"], angle: 0, keys: "ArrowUp W" },
  { name: "ahead_right", directions: ["ahead", "right"], angle: -45, keys: "ArrowUp+ArrowRight" },
  { name: "left", directions: ["left"], angle: 90, keys: "ArrowLeft A" },
  undefined,
  { name: "right", directions: ["right"], angle: -90, keys: "ArrowRight D" },
  { name: "back_left", directions: ["back", "left"], angle: 135, keys: "ArrowDown+ArrowLeft" },
  { name: "back", directions: ["back"], angle: 180, keys: "ArrowDown S" },
  { name: "back_right", directions: ["back", "right"], angle: -135, keys: "ArrowDown+ArrowRight" },
];
const kTurns = [
  { direction: "turn_left", keys: "Q" },
  { direction: "turn_right", keys: "E" },
] as const;

/** Eight ways and two turns, for the thumb that does not hold. A way and a turn together are an arc. */
export function DrivePad({
  control,
  state,
  sideways,
}: {
  control: HandHeld;
  state: HandState;
  sideways: boolean;
}) {
  const { t } = useTranslation("drive");
  const asleep = !state.mine;
  const press = (directions: readonly Direction[], down: boolean) => {
    for (const direction of directions) control.press(direction, down);
  };
  return (
    <div className="dpad" role="group" aria-label={t("pad.label")}>
      <div className="padways">
        {kWay.map((key) =>
          key === undefined ? (
            <span key="middle" className="mid" aria-hidden="true" />
          ) : (
            <HoldButton
              key={key.name}
              label={t(`pad.${key.name}`)}
              shortcuts={key.keys}
              disabled={asleep || (!sideways && key.directions.some((d) => d === "left" || d === "right"))}
              down={isDown(key.directions, state.pressed)}
              onDown={(down) => press(key.directions, down)}
            >
              <svg viewBox="0 0 24 24" aria-hidden="true" style={{ rotate: `${-key.angle}deg` }}>
                <path d="M12 20V5M5.5 11.5 12 5l6.5 6.5" />
              </svg>
            </HoldButton>
          ),
        )}
      </div>
      <div className="turns">
        {kTurns.map(({ direction, keys }) => (
          <HoldButton
            key={direction}
            label={t(`pad.${direction}`)}
            shortcuts={keys}
            disabled={asleep}
            down={state.pressed.has(direction)}
            onDown={(down) => press([direction], down)}
          >
            <svg
              viewBox="0 0 24 24"
              aria-hidden="true"
              style={direction === "turn_right" ? { scale: "-1 1" } : undefined}
            >
              <path d="M5 9.5A8 8 0 1 1 4.5 15M5 3.5V9.5H11" />
            </svg>
            <span>{t(`pad.${direction}_short`)}</span>
          </HoldButton>
        ))}
      </div>
    </div>
  );
}

/** Exactly these of the four ways are pressed. */
function isDown(directions: readonly Direction[], pressed: ReadonlySet<Direction>): boolean {
  const ways = (["ahead", "back", "left", "right"] as const).filter((way) => pressed.has(way));
  return ways.length === directions.length && directions.every((direction) => pressed.has(direction));
}
