import { useId } from "react";
import { useTranslation } from "react-i18next";
import type { VehicleType } from "@/shared/api/types";
import { millimetres } from "@/shared/words/format";
import { BracketChoice } from "./BracketChoice";
import { bracketsWanted, type BracketLift, type BracketsDraft } from "./bracketStep";
import "./BracketFields.css";

export interface BracketFieldsProps {
  draft: BracketsDraft;
  lift: BracketLift;
  /** One of those that have these brackets, for the names of their corners. */
  type: VehicleType | undefined;
  onChange: (draft: BracketsDraft) => void;
}

/** Which brackets go to which height on arrival; what is wrong with that stands beside it. */
export function BracketFields({ draft, lift, type, onChange }: BracketFieldsProps) {
  const { t } = useTranslation("body");
  const said = useId();
  const { fault } = bracketsWanted(draft, lift);
  const most = millimetres(lift.stroke_m);
  const bad = fault !== undefined && fault !== "empty";
  return (
    <div className="bheight">
      <BracketChoice
        type={type}
        names={lift.names}
        chosen={draft.bracket}
        onChoose={(bracket) => onChange({ ...draft, bracket })}
      />
      <label className="row">
        <span>{t("lifts.height")}</span>
        <input
          type="text"
          inputMode="decimal"
          value={draft.text}
          aria-invalid={bad}
          aria-describedby={said}
          onChange={(event) => onChange({ ...draft, text: event.target.value })}
        />
        <span id={said} className={bad ? "wrong" : "lab"} role={bad ? "alert" : undefined}>
          {fault === "no_such_bracket" ? t("lifts.no_such_bracket") : t("lifts.bad_height", { most })}
        </span>
      </label>
    </div>
  );
}
