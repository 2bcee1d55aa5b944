import { useTranslation } from "react-i18next";
import type { ModeOption, MotionMode } from "@/shared/api/types";
import { useWords } from "@/shared/words/useWords";
import { areasOf, dashes } from "./previewOverlays";

export interface AreasProps {
  /** All feasible modes. */
  options: readonly ModeOption[];
  chosen: ModeOption | undefined;
  /** The mode that the person looks at in the list. */
  looked: MotionMode | undefined;
}

/** Which line is which mode, where there is more than one, and what the rings are. */
export function AreasLegend(props: AreasProps) {
  const { t } = useTranslation("send");
  const words = useWords();
  const codes = props.chosen?.marker_chain?.markers.length ?? 0;
  const told = props.options.length < 2 ? [] : props.options;
  if (told.length === 0 && codes === 0) return null;
  const looks = new Map(areasOf({ ...props, option: props.chosen }).map((a) => [a.mode, a.look]));
  return (
    <ul className="areas" aria-label={t("preview.areas")}>
      {told.map((o) => {
        const look = looks.get(o.mode) ?? "other";
        return (
          <li key={o.mode} className={look} data-mode={o.mode}>
            <svg viewBox="0 0 32 12" className="m" aria-hidden="true">
              {look === "chosen" ? (
                <rect className="sample" x="1" y="1" width="30" height="10" />
              ) : (
                <path className={`swept-${look}`} strokeDasharray={dashes[o.mode].join(" ")} d="M1 6H31" />
              )}
            </svg>
            {words.modeShort(o.mode)}
          </li>
        );
      })}
      {codes > 0 && (
        <li data-chain={codes}>
          <svg viewBox="0 0 12 12" className="ring" aria-hidden="true">
            <circle cx="6" cy="6" r="4.5" />
          </svg>
          {t("preview.codes", { count: codes })}
        </li>
      )}
    </ul>
  );
}
