import { Trans, useTranslation } from "react-i18next";
import type { Plant, Vehicle } from "@/shared/api/types";
import { LoadLink } from "@/shared/body/LoadLink";
import { symbolOf, useLive } from "@/shared/live";
import { StatusSymbol, VehicleMini } from "@/shared/ui";
import { mass } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import "./VehicleStep.css";

/** Platforms first, then by name; a silent one stays in the list, marked. */
export function sortForSending(vehicles: readonly Vehicle[], plant: Plant | undefined): Vehicle[] {
  const isPlatform = (v: Vehicle) =>
    plant?.vehicle_types.find((type) => type.id === v.type)?.kinematics === "steered_platform" ? 0 : 1;
  return [...vehicles].sort(
    (a, b) => isPlatform(a) - isPlatform(b) || a.name.localeCompare(b.name, "en", { numeric: true }),
  );
}

export function usePlace(): (vehicle: Vehicle) => string {
  const { t } = useTranslation("send");
  const words = useWords();
  return (vehicle) =>
    vehicle.at_station
      ? t("vehicle.at_station", { number: words.stationNumber(vehicle.at_station) })
      : t("vehicle.between");
}

export interface VehicleStepProps {
  vehicles: readonly Vehicle[];
  plant: Plant | undefined;
  selected: Vehicle | undefined;
  choosing: boolean;
  onChoose: () => void;
  onSelect: (id: string) => void;
}

export function VehicleStep({ vehicles, plant, selected, choosing, onChoose, onSelect }: VehicleStepProps) {
  const { t } = useTranslation("send");
  const words = useWords();
  const place = usePlace();
  const ready = useLive((s) => s.ready);
  if (vehicles.length === 0) return ready ? <p className="lab">{t("vehicle.none")}</p> : null;
  if (selected && !choosing) {
    return (
      <div className="vrow">
        <VehicleMini type={plant?.vehicle_types.find((type) => type.id === selected.type)} selected />
        <div className="grow">
          <b className="big">{selected.name}</b>
          <span className="lab">
            {selected.load ? (
              <Trans
                t={t}
                i18nKey="vehicle.on_board"
                values={{ name: selected.load_name, mass: mass(selected.load_kg) }}
                components={{ load: <LoadLink id={selected.load} /> }}
              />
            ) : (
              t("vehicle.no_load")
            )}
            {t("words.join")}
            {place(selected)}
          </span>
          {words.inHand(selected) !== undefined && <b className="hand">{words.inHand(selected)}</b>}
        </div>
        {vehicles.length > 1 && (
          <button type="button" className="btn" onClick={onChoose}>
            {t("change")}
          </button>
        )}
      </div>
    );
  }
  return (
    <div className="vlist" role="listbox" aria-label={t("vehicle.list")} tabIndex={-1}>
      {vehicles.map((vehicle) => (
        <VehicleRow
          key={vehicle.id}
          vehicle={vehicle}
          selected={vehicle.id === selected?.id}
          onSelect={onSelect}
        />
      ))}
    </div>
  );
}

function VehicleRow({
  vehicle,
  selected,
  onSelect,
}: {
  vehicle: Vehicle;
  selected: boolean;
  onSelect: (id: string) => void;
}) {
  const { t } = useTranslation(["send", "words"]);
  const words = useWords();
  const place = usePlace();
  return (
    <button
      type="button"
      role="option"
      aria-selected={selected}
      className={`veh pick ${selected ? "sel" : ""}`}
      onClick={() => onSelect(vehicle.id)}
    >
      <StatusSymbol name={symbolOf(vehicle)} />
      <span className="id">{vehicle.name}</span>
      <span className="what">{words.inHand(vehicle) ?? place(vehicle)}</span>
      <span className="when">
        {vehicle.link !== "live" ? t(`words:link.${vehicle.link}`) : t(`words:activity.${vehicle.activity}`)}
      </span>
    </button>
  );
}
