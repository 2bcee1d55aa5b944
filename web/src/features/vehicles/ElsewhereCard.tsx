import { useState } from "react";
import { useTranslation } from "react-i18next";
import type { Plant, Vehicle } from "@/shared/api/types";
import { useMayCommand } from "@/shared/live";
import { Link } from "@/shared/router";
import { Button } from "@/shared/ui";
import { InitPositionCard } from "./InitPositionCard";
import "./ElsewhereCard.css";

/** "It stands elsewhere": the way to tell a vehicle its place, on the map or in numbers. Open when it does not know. */
export function ElsewhereCard({
  vehicle,
  plant,
  refused,
}: {
  vehicle: Vehicle;
  plant: Plant | undefined;
  refused: string | undefined;
}) {
  const { t } = useTranslation("vehicles");
  const may = useMayCommand();
  const [open, setOpen] = useState(false);
  const shown = open || !vehicle.pose_known;
  return (
    <>
      {may && (
        <div className="card elsewhere">
          <b>{t("elsewhere.title")}</b>
          {!shown && <Button onPress={() => setOpen(true)}>{t("elsewhere.numbers")}</Button>}
          <Link className="btn" to={`/map?place=${encodeURIComponent(vehicle.id)}`}>
            {t("elsewhere.map")}
          </Link>
        </div>
      )}
      {shown && <InitPositionCard vehicle={vehicle} plant={plant} refused={refused} />}
    </>
  );
}
