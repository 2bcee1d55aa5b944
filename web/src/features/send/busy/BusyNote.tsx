import { useTranslation } from "react-i18next";
import type { NewJobOrder, Vehicle } from "@/shared/api/types";
import { symbolOf } from "@/shared/live";
import { Link } from "@/shared/router";
import { CommandButton, StatusSymbol } from "@/shared/ui";
import type { Busy } from "./busy";
import { useBusyWords } from "./useBusyWords";
import type { Start } from "../start/useStart";
import "./BusyNote.css";
import { useWords } from "@/shared/words/useWords";

export interface BusyNoteProps {
  busy: Busy;
  vehicle: Vehicle;
  start: Start;
  /** What would be sent; undefined while nothing may be. */
  body: NewJobOrder | undefined;
  /** Why nothing may be sent now. */
  why: string | undefined;
}

/** The vehicle has something to do already: for whom, where to, until when, and what can be done about it. */
export function BusyNote({ busy, vehicle, start, body, why }: BusyNoteProps) {
  const { t } = useTranslation("send");
  const words = useWords();
  const say = useBusyWords();
  const { order } = busy;
  const names = { order: order.name, by: words.actor(order.created_by), vehicle: vehicle.name };
  const { command } = start;
  return (
    <div className="card busy" role="group" aria-label={t("busy.title")}>
      <StatusSymbol name={symbolOf(vehicle)} />
      <div className="grow">
        <strong role="status">{say(busy, vehicle)}</strong>
        <span className="lab">{t("busy.acts", names)}</span>
      </div>
      <Link className="btn motion" to={`/orders/${order.id}`}>
        {t("busy.show", names)}
      </Link>
      <CommandButton
        className="replace"
        label={t("busy.replace", names)}
        primary={false}
        direction="go"
        progress={
          command.kind === "requested" ? { kind: "requested", atMs: command.sinceMs } : { kind: "ready" }
        }
        disabledReason={order.cancel_requested ? t("busy.cancelled_already") : why}
        onRun={() => body && start.replace(anyMode(body), order)}
      />
    </div>
  );
}

/** Where the vehicle will stand when the other order has been cancelled is not known yet, so the server takes the mode then. */
function anyMode(body: NewJobOrder): NewJobOrder {
  return { ...body, steps: body.steps.map((step) => ({ ...step, motion_mode: "auto" as const })) };
}
