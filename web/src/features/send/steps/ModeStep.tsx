import type { KeyboardEvent } from "react";
import { useTranslation } from "react-i18next";
import type { ModeOption, MotionMode, Plant } from "@/shared/api/types";
import { ModeIcon, StatusSymbol, type ModeIconName } from "@/shared/ui";
import { duration, length } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { capitalise, deviationValues, moveWords } from "../preview/moveWords";
import { OtherWays } from "../preview/OtherWays";
import { chosenOption, sortOptions, type Preview, type StepPreview } from "../preview/preview";
import "./ModeStep.css";

export const modeIcon: Record<MotionMode, ModeIconName> = {
  auto: "m-auto",
  linear: "m-lin",
  fixed_axis_rotation: "m-arc",
  self_rotation: "m-rot",
  lateral: "m-lat",
  oblique: "m-obl",
  combined: "m-comb",
  free: "m-free",
};

export interface ModeStepProps {
  preview: Preview;
  step: StepPreview | undefined;
  plant: Plant | undefined;
  /** Why there are no modes, when it is not that nothing has been chosen yet. */
  instead: string | undefined;
  mode: MotionMode;
  onMode: (mode: MotionMode) => void;
  /** The mode under the pointer or the focus: the map shows its area. */
  onLook: (mode: MotionMode | undefined) => void;
}

export function ModeStep({ preview, step, plant, instead, mode, onMode, onLook }: ModeStepProps) {
  const { t } = useTranslation("send");
  if (!step) {
    const wait = preview.kind === "loading" ? "checks.asking" : "mode.wait";
    return <p className="lab pad-top">{instead ?? t(wait)}</p>;
  }
  const options = sortOptions(step.options);
  const chosen = chosenOption(step, mode);
  return (
    <>
      <div role="radiogroup" aria-label={t("mode.title")} onKeyDown={moveFocus}>
        {options.map((option, i) => (
          <ModeRow
            key={option.mode}
            option={option}
            checked={option.mode === chosen?.mode}
            tabStop={chosen ? option.mode === chosen.mode : i === 0}
            // The suggested row is mode auto: it stays the suggestion when the pose changes.
            onSelect={() => onMode(option.suggested ? "auto" : option.mode)}
            onLook={onLook}
          />
        ))}
        {options.length > 0 && !options.some((o) => o.feasible) && <p className="lab">{t("mode.none")}</p>}
      </div>
      <OtherWays ways={step.alternatives} plant={plant} />
    </>
  );
}

const steps: Readonly<Record<string, number>> = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 };

/** Arrows only look: what they pass over must not become what Start would send. Space and Enter choose. */
function moveFocus(event: KeyboardEvent<HTMLElement>) {
  const step = steps[event.key];
  if (step === undefined) return;
  const rows = [...event.currentTarget.querySelectorAll<HTMLElement>("[role=radio]")];
  const at = rows.indexOf(document.activeElement as HTMLElement);
  rows[(at + step + rows.length) % rows.length]?.focus();
  event.preventDefault();
}

function ModeRow(props: {
  option: ModeOption;
  checked: boolean;
  tabStop: boolean;
  onSelect: () => void;
  onLook: (mode: MotionMode | undefined) => void;
}) {
  const { option, checked, tabStop, onSelect, onLook } = props;
  const { t } = useTranslation("send");
  const words = useWords();
  const look = () => onLook(option.mode);
  const lookAway = () => onLook(undefined);
  return (
    <button
      type="button"
      role="radio"
      tabIndex={tabStop ? 0 : -1}
      aria-checked={checked}
      aria-disabled={!option.feasible}
      className={`mode ${checked && option.feasible ? "on" : ""} ${option.feasible ? "" : "off"}`}
      data-mode={option.mode}
      onClick={() => option.feasible && onSelect()}
      onPointerEnter={look}
      onPointerLeave={lookAway}
      onFocus={look}
      onBlur={lookAway}
    >
      <span className="mi">
        <ModeIcon name={modeIcon[option.mode]} />
      </span>
      <span className="grow">
        <b>{words.mode(option.mode)}</b>
        {option.suggested && option.feasible && <i className="sug">{t("mode.suggested")}</i>}
        {option.feasible ? (
          <>
            {checked && <span className="what">{way(option)}</span>}
            <span className="what">{facts(option)}</span>
          </>
        ) : (
          <span className="what">{option.reason ? words.reason(option.reason) : t("mode.infeasible")}</span>
        )}
      </span>
      <em>{option.feasible ? duration(option.duration_s) : <StatusSymbol name="c-no" />}</em>
    </button>
  );

  function way(of: ModeOption): string {
    const move = capitalise(moveWords(of.segments ?? [], (key, params) => t(key, params), t("words.join")));
    const places = of.route?.length ?? 0;
    return places < 3 ? move : move + t("words.join") + t("mode.via", { count: places });
  }

  function facts(of: ModeOption): string {
    const parts = [t("mode.clear", { clearance: length(of.clearance_m) })];
    if (of.expected_deviation) {
      parts.push(t("mode.deviation_long", deviationValues(of.expected_deviation)));
    }
    return parts.join(t("words.join"));
  }
}
