import { useTranslation } from "react-i18next";
import type { Vehicle, VehicleType } from "@/shared/api/types";
import { feetDown } from "@/shared/live/feet";
import { Card } from "@/shared/ui";
import { age, fixed } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { summarise, titleOf } from "./drawing/loads";
import { PlatformDrawing } from "./drawing/PlatformDrawing";

/** The vehicle from above with what its sensors say of load, wheels and feet. */
export function LoadsCard({
  vehicle,
  type,
  stale,
  heard_s,
}: {
  vehicle: Vehicle;
  type: VehicleType | undefined;
  stale: boolean;
  heard_s: number | undefined;
}) {
  const { t } = useTranslation("body");
  const words = useWords();
  const summary = summarise(vehicle, type);
  const parts: string[] = [];
  if (summary) {
    parts.push(
      summary.total_n < 1000
        ? t("loads.no_load")
        : summary.fault === undefined
          ? t("loads.balanced", { count: summary.brackets.length * 2 })
          : summary.fault.code === "load_unbalanced"
            ? t("loads.unbalanced", { percent: fixed(summary.worst * 100, 1) })
            : words.reason(summary.fault),
    );
  }
  if (vehicle.parking_feet.length > 0) {
    parts.push(t(feetDown(vehicle.parking_feet) ? "loads.feet_lowered" : "loads.feet_raised"));
  }
  return (
    <Card
      className="pcard"
      title={t(titleOf(vehicle, type))}
      summary={parts.join(t("join"))}
      right={age(heard_s)}
      flush
    >
      <PlatformDrawing vehicle={vehicle} type={type} stale={stale} />
    </Card>
  );
}
