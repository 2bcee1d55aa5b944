import { useTranslation } from "react-i18next";
import type { ModeOption, MotionMode } from "@/shared/api/types";
import { useWords } from "@/shared/words/useWords";
import { ringPath } from "./previewView";

/** Dashes in px that tell the outlines apart; the chosen mode has its hatching instead. */
const dashes: Record<MotionMode, string> = {
  auto: "",
  linear: "",
  fixed_axis_rotation: "9 4",
  self_rotation: "2 3",
  lateral: "12 3 2 3",
  oblique: "5 3",
  combined: "12 3 2 3 2 3",
  free: "1 5",
};

export interface AreasProps {
  /** All feasible modes. */
  options: readonly ModeOption[];
  chosen: ModeOption | undefined;
  /** The mode that the person looks at in the list. */
  looked: MotionMode | undefined;
}

type Look = "chosen" | "looked" | "other";

function lookOf(option: ModeOption, { chosen, looked }: AreasProps): Look {
  if (option.mode === chosen?.mode) return "chosen";
  return option.mode === looked ? "looked" : "other";
}

const layers: readonly Look[] = ["other", "looked", "chosen"];

/** What each mode would sweep: the chosen one hatched, the others as outlines below it. */
export function SweptAreas(props: AreasProps) {
  return (
    <>
      {layers.flatMap((layer) =>
        props.options
          .filter((o) => lookOf(o, props) === layer)
          .map((o) => (
            <path
              key={o.mode}
              className={layer === "chosen" ? "swept" : `swept-${layer}`}
              data-mode={o.mode}
              strokeDasharray={layer === "chosen" ? undefined : dashes[o.mode]}
              d={ringPath(o.swept ?? [])}
            />
          )),
      )}
    </>
  );
}

/** Which line is which mode; with one area there is nothing to tell apart. */
export function AreasLegend(props: AreasProps) {
  const { t } = useTranslation("send");
  const words = useWords();
  if (props.options.length < 2) return null;
  return (
    <ul className="areas" aria-label={t("preview.areas")}>
      {props.options.map((o) => {
        const look = lookOf(o, props);
        return (
          <li key={o.mode} className={look} data-mode={o.mode}>
            <svg viewBox="0 0 32 12" className="m" aria-hidden="true">
              {look === "chosen" ? (
                <rect className="sample" x="1" y="1" width="30" height="10" />
              ) : (
                <path className={`swept-${look}`} strokeDasharray={dashes[o.mode]} d="M1 6H31" />
              )}
            </svg>
            {words.modeShort(o.mode)}
          </li>
        );
      })}
    </ul>
  );
}
