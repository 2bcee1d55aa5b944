import { useTranslation } from "react-i18next";
import type { JobOrder, Step, StopRecord } from "@/shared/api/types";
import { Link } from "@/shared/router";
import { degrees, millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { useOrderStops } from "./useOrders";

/** The stations of an order in the order in which they are visited, each with its stop. */
export function OrderSteps({ order }: { order: JobOrder }) {
  const { t } = useTranslation("orders");
  const stops = useOrderStops(order);
  return (
    <table>
      <thead>
        <tr>
          <th>{t("detail.station")}</th>
          <th>{t("detail.mode")}</th>
          <th>{t("detail.state")}</th>
          <th className="n">{t("detail.stop")}</th>
          <th>
            <span className="sr-only">{t("detail.to_record")}</span>
          </th>
        </tr>
      </thead>
      <tbody>
        {order.steps.map((step, i) => (
          <StepRow
            key={i}
            step={step}
            stop={stops.get(step.stop ?? "")}
            present={i === order.current_step && step.state !== "done"}
          />
        ))}
      </tbody>
    </table>
  );
}

function StepRow({ step, stop, present }: { step: Step; stop: StopRecord | undefined; present: boolean }) {
  const { t } = useTranslation(["orders", "words"]);
  const words = useWords();
  return (
    <tr className={present ? "on" : ""}>
      <td className="b">{step.number}</td>
      <td>{words.modeShort(stop?.mode ?? step.motion_mode)}</td>
      <td>
        {t(`words:step.${step.state}`)}
        <StepActions step={step} />
      </td>
      <td className="n">{stop ? deviation(stop) : "\u2013"}</td>
      <td>
        {step.stop && (
          <Link className="cell-link" to={`/records/${step.stop}`}>
            {t("detail.to_record")}
          </Link>
        )}
      </td>
    </tr>
  );
}

function deviation(stop: StopRecord): string {
  const mm = (m: number) => millimetres(m, { decimals: 2, sign: true });
  return `${mm(stop.dx_m)}, ${mm(stop.dy_m)} mm, ${degrees(stop.dheading_rad, { sign: true })}°`;
}

/** The actions around a step, in the order in which they are done. */
function StepActions({ step }: { step: Step }) {
  const { t } = useTranslation("orders");
  const words = useWords();
  const line = (key: string, actions: Step["before"] = []) =>
    actions.length > 0 && (
      <div className="cap">{t(key, { actions: actions.map(words.action).join(t("join")) })}</div>
    );
  return (
    <>
      {line("detail.actions_before", step.before)}
      {line("detail.actions_after", step.after)}
    </>
  );
}
