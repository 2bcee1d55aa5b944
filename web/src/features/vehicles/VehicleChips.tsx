import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { pressed, symbolOf } from "@/shared/live";
import { Chip } from "@/shared/ui";
import { fixed } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { LoadOf } from "./LoadOf";

/** Where it is, how it drives, what it carries, charge and fields, a word each. */
export function VehicleChips({ vehicle, stale }: { vehicle: Vehicle; stale: boolean }) {
  const { t } = useTranslation(["vehicles", "words"]);
  const words = useWords();
  const stopped = pressed(vehicle);
  return (
    <div className={`chips ${stale ? "old" : ""}`}>
      <Chip symbol={symbolOf(vehicle)}>
        {vehicle.link !== "live"
          ? t(`words:link.${vehicle.link}`)
          : vehicle.at_station && vehicle.activity !== "moving"
            ? t("chip.at_station", { number: words.stationNumber(vehicle.at_station) })
            : t(`words:activity.${vehicle.activity}`)}
      </Chip>
      {vehicle.integration !== "utilise" && (
        <Chip symbol="a-2">{t(`integration.level.${vehicle.integration}`)}</Chip>
      )}
      {!vehicle.pose_known && <Chip symbol="a-2">{t("chip.pose_unknown")}</Chip>}
      {vehicle.link !== "never" && (
        <>
          <Chip>
            {words.inHand(vehicle) ??
              t(`words:operating_mode.${vehicle.operating_mode}`, { defaultValue: vehicle.operating_mode })}
          </Chip>
          <Chip>
            <LoadOf vehicle={vehicle} />
          </Chip>
          <Chip symbol="s-charge">{fixed(vehicle.battery_percent, 0)} %</Chip>
          <Chip symbol={stopped || vehicle.field_violation ? "a-2" : stale ? "s-stale" : "c-ok"}>
            {stopped
              ? t("chip.e_stop")
              : t(vehicle.field_violation ? "chip.field_violation" : "chip.fields_clear")}
          </Chip>
        </>
      )}
    </div>
  );
}
