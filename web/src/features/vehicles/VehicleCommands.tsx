import { useTranslation } from "react-i18next";
import type { JobOrder, Vehicle } from "@/shared/api/types";
import { CancelOrder, PauseVehicle } from "@/shared/commands";
import { Link } from "@/shared/router";
import { Icon } from "@/shared/ui";

/** Pause, cancel, send: each always at its place. Resume has one of its own, below (HeldBar). */
export function VehicleCommands({ vehicle, order }: { vehicle: Vehicle; order: JobOrder | undefined }) {
  const { t } = useTranslation("vehicles");
  return (
    <>
      <PauseVehicle vehicle={vehicle} />
      <CancelOrder order={order} className="gt-sm" />
      <Link className="btn primary motion" to={`/send?vehicle=${encodeURIComponent(vehicle.id)}`}>
        <Icon name="send" />
        <span>{t("command.send")}</span>
      </Link>
    </>
  );
}
