import { useCallback, useEffect } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { JobOrder } from "@/shared/api/types";
import { useCommandsEnabled, useMayCommand } from "@/shared/live";
import { CommandButton, type CommandProgress } from "@/shared/ui";
import { useCommand } from "@/shared/ui/useCommand";
import { useWords } from "@/shared/words/useWords";
import { actionsOf } from "./orderLook";

type Method = "pause" | "resume" | "cancel";

function send(method: Method, id: string): Promise<unknown> {
  const params = { path: { id } };
  switch (method) {
    case "pause":
      return call(api.POST("/api/v1/job-orders/{id}/pause", { params }));
    case "resume":
      return call(api.POST("/api/v1/job-orders/{id}/resume", { params }));
    case "cancel":
      return call(api.POST("/api/v1/job-orders/{id}/cancel", { params }));
  }
}

/** Pause, resume, cancel; each two-step, each shown as done only when the server's order says so. */
export function OrderCommands({ order }: { order: JobOrder }) {
  const can = actionsOf(order);
  const anything = can.pause || can.resume || can.cancel || order.pause_requested || order.cancel_requested;
  if (!anything) return null;
  return (
    <div className="ocmds">
      {(can.pause || (order.pause_requested && !can.resume)) && (
        <OrderCommand order={order} method="pause" requested={order.pause_requested} />
      )}
      {can.resume && <OrderCommand order={order} method="resume" requested={false} />}
      {(can.cancel || order.cancel_requested) && (
        <OrderCommand order={order} method="cancel" requested={order.cancel_requested} />
      )}
    </div>
  );
}

function OrderCommand({ order, method, requested }: { order: JobOrder; method: Method; requested: boolean }) {
  const { t } = useTranslation("orders");
  const words = useWords();
  const linkUp = useCommandsEnabled();
  const mayCommand = useMayCommand();
  const { asked, run, reset } = useCommand(useCallback(() => send(method, order.id), [method, order.id]));
  const { revision } = order;
  // The order itself has changed: what was asked for is in it now.
  useEffect(() => reset(), [revision, reset]);
  const vehicle = order.vehicle ? words.vehicle(order.vehicle) : order.name;
  const progress: CommandProgress =
    asked.kind === "requested"
      ? { kind: "requested", atMs: asked.atMs }
      : requested || asked.kind === "stored"
        ? { kind: "accepted", waitingFor: vehicle }
        : { kind: "ready" };
  return (
    <div>
      <CommandButton
        label={t(`command.${method}`)}
        primary={false}
        progress={progress}
        disabledReason={!linkUp ? t("command.offline") : !mayCommand ? t("command.not_allowed") : undefined}
        onRun={run}
      />
      {asked.kind === "failed" && (
        <p className="lab" role="alert">
          {t("command.failed", {
            detail: words.problem(asked.problem),
            request: asked.problem.requestId.slice(0, 8),
          })}
        </p>
      )}
    </div>
  );
}
