import { useMemo } from "react";
import { useTranslation } from "react-i18next";
import { alarms, useLinkLost, useVehicles } from "@/shared/live";
import { Link } from "@/shared/router";
import { StatusSymbol, type SymbolName } from "@/shared/ui";
import "./AlarmCounts.css";

const kRows = [
  { priority: "critical", cls: "has-1", symbol: "a-1" },
  { priority: "high", cls: "has-2", symbol: "a-2" },
  { priority: "low", cls: "has-3", symbol: "a-3" },
] as const satisfies readonly { priority: string; cls: string; symbol: SymbolName }[];

/** How many vehicles are alarmed, by priority. None is a hollow grey diamond. */
export function AlarmCounts() {
  const { t } = useTranslation();
  const vehicles = useVehicles();
  const lost = useLinkLost();
  const all = useMemo(() => alarms(vehicles), [vehicles]);
  return (
    <div className={`cell alarms ${lost ? "old" : ""}`} role="group" aria-label={t("alarms.label")}>
      {kRows.map(({ priority, cls, symbol }) => {
        const count = all.filter((alarm) => alarm.priority === priority).length;
        const name = t(`alarms.${priority}`, { count });
        return (
          <Link
            key={priority}
            to="/map"
            className={`al ${count > 0 ? cls : "none"}`}
            title={name}
            aria-label={name}
          >
            <StatusSymbol name={count > 0 ? symbol : "a-1o"} />
            {count}
          </Link>
        );
      })}
    </div>
  );
}
