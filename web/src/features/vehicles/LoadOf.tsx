import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { LoadLink } from "@/shared/body/LoadLink";
import { mass } from "@/shared/words/format";

/** What a vehicle carries, as the link to it, and how heavy that is. */
export function LoadOf({ vehicle: v }: { vehicle: Vehicle }) {
  const { t } = useTranslation("vehicles");
  const heavy = v.load_kg > 0 ? mass(v.load_kg) : "";
  if (v.load === undefined) return heavy || t("chip.no_load");
  return (
    <span>
      <LoadLink id={v.load}>{v.load_name}</LoadLink>
      {heavy !== "" && t("chip.weighs", { mass: heavy })}
    </span>
  );
}
