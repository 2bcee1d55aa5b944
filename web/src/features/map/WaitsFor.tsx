import { useTranslation } from "react-i18next";
import type { JobOrder, Vehicle } from "@/shared/api/types";
import { symbolOf, useLive, waitChain } from "@/shared/live";
import { StatusSymbol } from "@/shared/ui";
import { useVehicleWords } from "./vehicleWords";

const kShown = 3;

export interface WaitsForProps {
  vehicle: Vehicle;
  vehicles: ReadonlyMap<string, Vehicle>;
  numberOf: (station: string) => string | undefined;
  onSelect: (vehicle: string) => void;
}

/** Whom a vehicle waits for, whom that one waits for, and so on, each with what it says itself; and where that ends. */
export function WaitsFor({ vehicle, vehicles, numberOf, onSelect }: WaitsForProps) {
  const { t } = useTranslation("map");
  const words = useVehicleWords(numberOf, vehicles);
  const orders = useLive((s) => s.jobOrders);
  const { ids, loop } = waitChain(vehicle, vehicles);
  if (ids.length === 0) return null;
  const orderOf = (v: Vehicle): JobOrder | undefined => (v.order ? orders.get(v.order) : undefined);
  const hidden = ids.length - kShown;
  return (
    <div className="chain" role="group" aria-label={t("card.chain")}>
      <h3 className="cap">{t("card.chain")}</h3>
      <ol>
        {ids.slice(0, kShown).map((id) => {
          const v = vehicles.get(id)!;
          const { doing, why } = words(v, orderOf(v));
          return (
            <li key={id}>
              <button type="button" className="linkrow" onClick={() => onSelect(id)}>
                <StatusSymbol name={symbolOf(v)} />
                <b>{v.name}</b>
                <span className="lab">{why === "" ? doing : why}</span>
              </button>
            </li>
          );
        })}
      </ol>
      {hidden > 0 && <p className="cap">{t("card.chain_more", { count: hidden })}</p>}
      {loop && <p className="lab">{t("card.loop")}</p>}
    </div>
  );
}
