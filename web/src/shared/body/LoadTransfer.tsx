import { useMemo } from "react";
import { useTranslation } from "react-i18next";
import type { LiftCommand, Vehicle } from "@/shared/api/types";
import { useLoads, useStations } from "@/shared/live";
import { LoadButton } from "./LoadButton";
import { useLift } from "./useLift";

/** Taking over what hangs or stands where the vehicle stands, or setting down there what it carries. */
export function LoadTransfer({ vehicle, refused }: { vehicle: Vehicle; refused: string | undefined }) {
  const { t } = useTranslation("body");
  const loads = useLoads().data ?? [];
  const here = useStations().find((station) => station.id === vehicle.at_station);
  const wanted = vehicle.load ?? here?.state?.load;
  const type = vehicle.load === undefined ? "pick" : "drop";
  const body = useMemo<LiftCommand | undefined>(
    () => (wanted === undefined ? undefined : type === "pick" ? { type, load: wanted } : { type }),
    [type, wanted],
  );
  const { command, progress } = useLift(vehicle, type, body);
  if (here?.support === undefined || wanted === undefined) return null;
  const name = loads.find((load) => load.id === wanted)?.name ?? wanted;
  const label = t(type === "pick" ? "lifts.take_over" : "lifts.set_down", { load: name });
  return <LoadButton {...{ label, vehicle, type, command, progress, refused }} />;
}
