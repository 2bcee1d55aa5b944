import { useTranslation } from "react-i18next";
import type { VehicleType } from "@/shared/api/types";
import { Choice } from "./Choice";
import { bracketKey } from "./drawing/faceplate";

/** All brackets in step, or one by its corner. */
export function BracketChoice(props: {
  /** Which has them. */
  type: VehicleType | undefined;
  names: readonly string[];
  chosen: string;
  onChoose: (name: string) => void;
}) {
  const { t } = useTranslation("body");
  const { type, names, chosen, onChoose } = props;
  return (
    <Choice
      label={t("lifts.which")}
      all={t("lifts.all")}
      names={names.map((name) => ({
        name,
        label: t(`loads.bracket.${bracketKey(type, name)}`, { defaultValue: name }),
      }))}
      chosen={chosen}
      onChoose={onChoose}
    />
  );
}
