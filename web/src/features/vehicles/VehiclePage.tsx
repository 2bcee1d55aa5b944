import { useTranslation } from "react-i18next";
import { useLive, useVehicle } from "@/shared/live";
import { Link } from "@/shared/router";
import { Card, PanelEmpty, PanelLoading } from "@/shared/ui";
import { Faceplate } from "./Faceplate";

/** The faceplate of a vehicle, or the words that there is none of that name. */
export function VehiclePage({ id }: { id: string }) {
  const { t } = useTranslation("vehicles");
  const vehicle = useVehicle(id);
  const ready = useLive((s) => s.ready);
  if (vehicle) return <Faceplate vehicle={vehicle} />;
  if (!ready) return <PanelLoading what={id} />;
  return (
    <Card>
      <PanelEmpty
        what={t("not_found", { id })}
        when={t("not_found_hint")}
        action={
          <Link className="btn" to="/vehicles">
            {t("to_list")}
          </Link>
        }
      />
    </Card>
  );
}
