import { useCallback } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { JobOrder } from "@/shared/api/types";
import { CancelOrder, CommandFailed, useOverdue, useRefusal } from "@/shared/commands";
import { CommandButton } from "@/shared/ui";
import { useCommand, useProgress } from "@/shared/ui/useCommand";
import { useWords } from "@/shared/words/useWords";
import { actionsOf, pauseProgress } from "./orderLook";
import "./OrderCommands.css";

/** Pause, cancel, resume; each shown as done only when the server's order says so. */
export function OrderCommands({ order }: { order: JobOrder }) {
  const can = actionsOf(order);
  if (!can.pause && !can.resume && !can.cancel) return null;
  return (
    <div className="ocmds">
      {can.pause && <PauseOrder order={order} />}
      <CancelOrder order={order} />
      {can.resume && <ResumeOrder order={order} />}
    </div>
  );
}

function PauseOrder({ order }: { order: JobOrder }) {
  const { t } = useTranslation("orders");
  const words = useWords();
  const refused = useRefusal();
  const { id } = order;
  const pause = useCommand(
    useCallback(() => call(api.POST("/api/v1/job-orders/{id}/pause", { params: { path: { id } } })), [id]),
  );
  const held = order.state === "Interrupted" || order.pause_requested;
  const vehicle = order.vehicle ? words.vehicle(order.vehicle) : order.name;
  const asked = useProgress(pause, held, vehicle);
  const progress = useOverdue(pauseProgress(order, asked, t), vehicle);
  return (
    <div>
      <CommandButton
        label={t("command.pause")}
        icon="pause"
        primary={false}
        twoStep={false}
        direction="stop"
        progress={progress}
        disabledReason={refused}
        onRun={pause.run}
      />
      <CommandFailed command={pause} />
    </div>
  );
}

function ResumeOrder({ order }: { order: JobOrder }) {
  const { t } = useTranslation("orders");
  const refused = useRefusal();
  const { id } = order;
  const resume = useCommand(
    useCallback(() => call(api.POST("/api/v1/job-orders/{id}/resume", { params: { path: { id } } })), [id]),
  );
  const progress = useProgress(resume, order.state === "Running", order.name);
  return (
    <div>
      <CommandButton
        label={t("command.resume")}
        icon="play"
        primary={false}
        direction="go"
        progress={progress}
        disabledReason={refused}
        onRun={resume.run}
      />
      <CommandFailed command={resume} />
    </div>
  );
}
