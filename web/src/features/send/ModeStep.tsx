import { useTranslation } from "react-i18next";
import type { ModeOption, MotionMode } from "@/shared/api/types";
import { ModeIcon, StatusSymbol, type ModeIconName } from "@/shared/ui";
import { duration, length } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { capitalise, moveWords } from "./moveWords";
import { OtherWays } from "./OtherWays";
import { chosenOption, sortOptions, type Preview, type StepPreview } from "./preview";

export const modeIcon: Record<MotionMode, ModeIconName> = {
  auto: "m-auto",
  linear: "m-lin",
  fixed_axis_rotation: "m-arc",
  self_rotation: "m-rot",
  lateral: "m-lat",
  free: "m-free",
};

export interface ModeStepProps {
  preview: Preview;
  step: StepPreview | undefined;
  mode: MotionMode;
  onMode: (mode: MotionMode) => void;
}

export function ModeStep({ preview, step, mode, onMode }: ModeStepProps) {
  const { t } = useTranslation("send");
  if (!step) {
    return <p className="lab pad-top">{t(preview.kind === "loading" ? "checks.asking" : "mode.wait")}</p>;
  }
  const options = sortOptions(step.options);
  const chosen = chosenOption(step, mode);
  const best = options.find((o) => o.suggested);
  return (
    <>
      <div role="radiogroup" aria-label={t("mode.title")}>
        {options.map((option) => (
          <ModeRow
            key={option.mode}
            option={option}
            best={best}
            checked={option.mode === chosen?.mode}
            // The suggested row is mode auto: it stays the suggestion when the pose changes.
            onSelect={() => onMode(option.suggested ? "auto" : option.mode)}
          />
        ))}
        {options.length > 0 && !options.some((o) => o.feasible) && <p className="lab">{t("mode.none")}</p>}
      </div>
      <OtherWays ways={step.alternatives} />
    </>
  );
}

function ModeRow(props: {
  option: ModeOption;
  best: ModeOption | undefined;
  checked: boolean;
  onSelect: () => void;
}) {
  const { option, best, checked, onSelect } = props;
  const { t } = useTranslation("send");
  const words = useWords();
  const slower =
    best && !option.suggested && option.duration_s !== undefined && best.duration_s !== undefined
      ? option.duration_s - best.duration_s
      : 0;
  const what = option.feasible
    ? capitalise(moveWords(option.segments ?? [], (key, params) => t(key, params), t("words.join")))
    : option.reason
      ? words.reason(option.reason)
      : t("mode.infeasible");
  return (
    <button
      type="button"
      role="radio"
      aria-checked={checked}
      aria-disabled={!option.feasible}
      className={`mode ${checked && option.feasible ? "on" : ""} ${option.feasible ? "" : "off"}`}
      onClick={() => option.feasible && onSelect()}
    >
      <span className="mi">
        <ModeIcon name={modeIcon[option.mode]} />
      </span>
      <span className="grow">
        <b>{words.mode(option.mode)}</b>
        {option.suggested && option.feasible && <i className="sug">{t("mode.suggested")}</i>}
        <span className="what">
          {what}
          {option.feasible && route(option)}
          {option.feasible && slower >= 1 && t("words.join") + t("mode.longer", { time: duration(slower) })}
        </span>
      </span>
      <em>{option.feasible ? duration(option.duration_s) : <StatusSymbol name="c-no" />}</em>
    </button>
  );

  function route(of: ModeOption): string {
    const places = of.route?.length ?? 0;
    if (places < 3) return "";
    return t("words.join") + t("mode.via", { count: places, length: length(of.length_m) });
  }
}
