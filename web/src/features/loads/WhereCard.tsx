import { useTranslation } from "react-i18next";
import { useMayCommand, useServerNow, useVehicle } from "@/shared/live";
import { Card } from "@/shared/ui";
import { dateTime } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { PlaceName } from "./PlaceName";
import { SayPlace } from "./SayPlace";
import type { LiveLoad } from "./useLiveLoads";

/** Where it is now, since when and by whom; and where somebody says that it is. */
export function WhereCard({ load }: { load: LiveLoad }) {
  const { t } = useTranslation("loads");
  const words = useWords();
  const now = useServerNow(60_000);
  const may = useMayCommand();
  const carrier = useVehicle(load.place.vehicle);
  const by = load.told?.by;
  const since =
    load.told &&
    t(by === undefined ? "since_plant" : "since_by", {
      time: dateTime(load.told.since, now),
      by: by === undefined ? "" : words.actor(by),
    });
  return (
    <Card className="lwhere" title={t("where.title")} {...(since !== undefined && { summary: since })}>
      <p className="ans1" role="status">
        <span>
          <PlaceName place={load.place} />
        </span>
        {carrier && (
          <span className="lab">
            {carrier.at_station
              ? t("place.at", { number: words.stationNumber(carrier.at_station) })
              : t("place.between")}
          </span>
        )}
      </p>
      {may && <SayPlace load={load} />}
    </Card>
  );
}
