import { useTranslation } from "react-i18next";
import { usePlant } from "@/shared/live";
import { Choices } from "./Choices";
import { kKinds, kLongestId, kLongestName, type FactsDraft } from "./factsDraft";
import { TextField } from "./TextField";

interface Props {
  draft: FactsDraft;
  /** It has its id for ever. */
  known: boolean;
  /** Fields that are wrong, and the id of the words that say why. */
  wrong: readonly (keyof FactsDraft)[];
  why: string;
  onChange: (part: Partial<FactsDraft>) => void;
}

/** All that a person can say of a load. */
export function FactsFields({ draft, known, wrong, why, onChange }: Props) {
  const { t } = useTranslation("loads");
  const types = usePlant().data?.vehicle_types ?? [];
  const names = new Map(types.map(({ id, name }) => [id, name]));
  // One that the plant has no more can be taken back, too.
  const offered = [...new Set([...names.keys(), ...draft.types])];
  const text = (
    field: "id" | "name" | "model" | "mass_kg" | "ahead_mm" | "left_mm",
    more: { decimal?: boolean; longest?: number; placeholder?: string } = {},
  ) => (
    <TextField
      label={t(`form.${field}`)}
      value={draft[field]}
      why={wrong.includes(field) ? why : undefined}
      onChange={(value) => onChange({ [field]: value })}
      {...more}
    />
  );
  return (
    <>
      <div className="fields">
        {!known && text("id", { longest: kLongestId })}
        {text("name", { longest: kLongestName, placeholder: draft.id })}
        {text("model", { longest: kLongestName })}
        {text("mass_kg", { decimal: true, placeholder: t("not_weighed") })}
      </div>
      <Choices
        label={t("form.kind")}
        options={kKinds.map((kind) => ({ id: kind, name: t(`kind.${kind}`) }))}
        chosen={[draft.kind]}
        why={wrong.includes("kind") ? why : undefined}
        onPress={(kind) => onChange({ kind })}
      />
      <div role="group" aria-label={t("form.centre")}>
        <span className="cap">{t("form.centre")}</span>
        <div className="fields">
          {text("ahead_mm", { decimal: true, placeholder: "0" })}
          {text("left_mm", { decimal: true, placeholder: "0" })}
        </div>
      </div>
      <Choices
        label={t("form.types")}
        options={offered.map((id) => ({ id, name: names.get(id) ?? id }))}
        chosen={draft.types}
        why={wrong.includes("types") ? why : undefined}
        onPress={(id) =>
          onChange({
            types: draft.types.includes(id) ? draft.types.filter((one) => one !== id) : [...draft.types, id],
          })
        }
      />
    </>
  );
}
