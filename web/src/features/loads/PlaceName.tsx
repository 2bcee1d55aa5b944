import { useTranslation } from "react-i18next";
import { Link } from "@/shared/router";
import { useWords } from "@/shared/words/useWords";

interface Props {
  place: { vehicle?: string; station?: number; former_station?: string };
}

/** A vehicle or a station as a link to it, or that it is in neither. */
export function PlaceName({ place: { vehicle, station, former_station } }: Props) {
  const { t } = useTranslation("loads");
  const words = useWords();
  const link = (to: string, name: string) => (
    <Link className="inline" to={to} onClick={(event) => event.stopPropagation()}>
      {name}
    </Link>
  );
  if (vehicle !== undefined) return link(`/vehicles/${encodeURIComponent(vehicle)}`, words.vehicle(vehicle));
  if (station !== undefined)
    return link(`/stations?find=${station}`, t("place.station", { number: station }));
  return former_station === undefined ? t("place.nowhere") : t("place.former", { station: former_station });
}
