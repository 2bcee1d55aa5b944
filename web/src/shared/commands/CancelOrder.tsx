import { useCallback } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { JobOrder } from "@/shared/api/types";
import { CommandButton, type CommandProgress } from "@/shared/ui";
import { useCommand, useProgress } from "@/shared/ui/useCommand";
import { useWords } from "@/shared/words/useWords";
import { CommandFailed } from "./CommandFailed";
import { isOpen } from "./orderState";
import { useOverdue } from "./useOverdue";
import { useRefusal } from "./useRefusal";

/** Cancels an order; done when the order itself says that it has ended. */
export function CancelOrder({
  order,
  className,
  label,
}: {
  order: JobOrder | undefined;
  className?: string;
  /** Which order, where it is not the one that the page is about. */
  label?: string;
}) {
  const { t } = useTranslation("commands");
  const words = useWords();
  const refused = useRefusal();
  const id = order?.id;
  const cancel = useCommand(
    useCallback(
      () =>
        id === undefined
          ? Promise.resolve()
          : call(api.POST("/api/v1/job-orders/{id}/cancel", { params: { path: { id } } })),
      [id],
    ),
  );
  const open = order !== undefined && isOpen(order);
  const vehicle = order?.vehicle ? words.vehicle(order.vehicle) : (order?.name ?? "");
  const asked = useProgress(cancel, !open, vehicle);
  const stored: CommandProgress =
    open && order.cancel_requested
      ? { kind: "under_way", title: t("cancelling"), small: t("until_stands", { vehicle }) }
      : asked;
  const progress = useOverdue(stored, vehicle);
  return (
    <>
      <CommandFailed command={cancel} />
      <CommandButton
        {...(className !== undefined && { className })}
        label={label ?? t("cancel")}
        primary={false}
        progress={progress}
        disabledReason={refused ?? (open || progress.kind !== "ready" ? undefined : t("no_order"))}
        onRun={cancel.run}
      />
    </>
  );
}
