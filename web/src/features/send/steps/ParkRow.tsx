import { useTranslation } from "react-i18next";
import "./ParkRow.css";

/** Whether the vehicle lowers its feet when its stop is inside the tolerance. */
export function ParkRow({ park, onPark }: { park: boolean; onPark: (park: boolean) => void }) {
  const { t } = useTranslation("send");
  return (
    <label className="row parkrow">
      <input type="checkbox" checked={park} onChange={(event) => onPark(event.target.checked)} />
      <span>{t("mode.park")}</span>
    </label>
  );
}
