import { useTranslation } from "react-i18next";
import { useVehicle } from "@/shared/live";
import { useWords } from "@/shared/words/useWords";
import { useCheckText } from "../steps/ChecksStep";
import type { Readiness } from "../preview/preview";

/** What holds a start back before anything is asked of the server: nothing else will be shown either. */
const kBeforeAsking = new Set<Readiness["kind"]>([
  "offline",
  "not_allowed",
  "unknown_station",
  "wrong_type",
  "on_its_way",
]);

export interface WhyNot {
  /** The first thing that holds a start back, in words; undefined when nothing does. */
  why: string | undefined;
  /** The same where it is also why modes, checks and preview are not there. */
  instead: string | undefined;
}

export function useWhyNot(r: Readiness): WhyNot {
  const { t } = useTranslation("send");
  const words = useWords();
  const text = useCheckText();
  const mover = useVehicle(r.kind === "on_its_way" ? r.vehicle : undefined);
  const why = say();
  return { why, instead: kBeforeAsking.has(r.kind) ? why : undefined };

  function say(): string | undefined {
    switch (r.kind) {
      case "ready":
        return undefined;
      case "infeasible":
        return t("start.infeasible", { mode: words.mode(r.option.mode) });
      case "check":
        return t("start.check", { name: t(`checks.name.${r.check.code}`), text: text(r.check) });
      case "problem":
        return words.reason(r.reason);
      case "wrong_type":
      case "unknown_station":
        return t(`start.${r.kind}`, { number: r.number });
      case "on_its_way":
        return onItsWay();
      case "brackets":
        return t(`start.brackets_${r.fault}`);
      default:
        return t(`start.${r.kind}`);
    }
  }

  function onItsWay(): string {
    const number = mover?.leg ? words.stationNumber(mover.leg.station) : "";
    return t("start.aside", { vehicle: mover?.name, number });
  }
}
