import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { useLoads, useStations, useVehicles } from "@/shared/live";
import { useWords } from "@/shared/words/useWords";
import { LoadButton } from "./LoadButton";
import { placesToSay, type SaidPlace } from "./lifts";
import { usePlaceLoad } from "./usePlaceLoad";

interface Props {
  vehicle: Vehicle;
  /** Why commands are off. */
  refused: string | undefined;
}

/** Nobody saw the end of a transfer: while the brackets contradict what is known, a person says where the load is. */
export function PlaceLoad({ vehicle, refused }: Props) {
  const { t } = useTranslation("body");
  const words = useWords();
  const loads = useLoads().data ?? [];
  const stations = useStations();
  const vehicles = useVehicles();
  const here = stations.find((station) => station.id === vehicle.at_station);
  const known = new Set([...vehicles.map((one) => one.load), ...stations.map((one) => one.state?.load)]);
  const said = placesToSay(
    vehicle,
    here && { ...here, load: loads.find((load) => load.id === here.state?.load) },
    loads.filter((load) => !known.has(load.id)),
  );
  if (said.length === 0 || vehicle.load_fault === undefined) return null;
  return (
    <>
      <p className="failed" role="status">
        {t("lifts.say", { why: words.reason(vehicle.load_fault) })}
      </p>
      {said.map((one) => (
        <PlaceButton
          key={one.load}
          vehicle={vehicle}
          refused={refused}
          said={one}
          name={loads.find((load) => load.id === one.load)?.name ?? one.load}
        />
      ))}
    </>
  );
}

function PlaceButton({ vehicle, refused, said, name }: Props & { said: SaidPlace; name: string }) {
  const { t } = useTranslation("body");
  const { load, is, station } = said;
  const place = is === "on_vehicle" ? { vehicle: vehicle.id } : station === undefined ? {} : { station };
  const there = (vehicle.load === load) === (is === "on_vehicle");
  const { command, progress } = usePlaceLoad(load, place, there, vehicle.name);
  const label = t(`lifts.${is}`, { load: name });
  return <LoadButton type="pick" {...{ label, vehicle, command, progress, refused }} />;
}
