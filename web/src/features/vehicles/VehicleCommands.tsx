import { useCallback, useEffect } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { JobOrder, Vehicle } from "@/shared/api/types";
import { Link } from "@/shared/router";
import { CommandButton, Icon } from "@/shared/ui";
import { useCommand, type Asked } from "@/shared/ui/useCommand";
import { useWords } from "@/shared/words/useWords";
import { progressOf } from "./commandProgress";

/** Pause or resume, withdraw, send. What is shown as done was reported, never assumed. */
export function VehicleCommands({
  vehicle,
  order,
  refused,
}: {
  vehicle: Vehicle;
  order: JobOrder | undefined;
  refused: string | undefined;
}) {
  const { t } = useTranslation("vehicles");
  const words = useWords();
  const pause = useCommand(
    useCallback(
      () => call(api.POST("/api/v1/vehicles/{id}/pause", { params: { path: { id: vehicle.id } } })),
      [vehicle.id],
    ),
  );
  const resume = useCommand(
    useCallback(
      () => call(api.POST("/api/v1/fleet/resume", { body: { vehicles: [vehicle.id] } })),
      [vehicle.id],
    ),
  );
  const orderId = order?.id;
  const withdraw = useCommand(
    useCallback(
      () =>
        orderId === undefined
          ? Promise.resolve()
          : call(api.POST("/api/v1/job-orders/{id}/cancel", { params: { path: { id: orderId } } })),
      [orderId],
    ),
  );
  const held = vehicle.paused || vehicle.needs_resume;
  useSettled(pause, vehicle.paused);
  useSettled(resume, !held);
  useSettled(withdraw, orderId === undefined);
  const failed = [pause.asked, resume.asked, withdraw.asked].find((a) => a.kind === "failed");
  return (
    <>
      {failed?.kind === "failed" && (
        <p className="lab failedline" role="alert">
          {t("failed", {
            detail: words.problem(failed.problem),
            request: failed.problem.requestId.slice(0, 8),
          })}
        </p>
      )}
      {held ? (
        <CommandButton
          label={t("command.resume")}
          icon="play"
          primary={false}
          progress={progressOf(resume.asked, vehicle.name)}
          disabledReason={refused}
          onRun={resume.run}
        />
      ) : (
        <CommandButton
          label={t("command.pause")}
          icon="pause"
          primary={false}
          twoStep={false}
          progress={progressOf(pause.asked, vehicle.name)}
          disabledReason={refused}
          onRun={pause.run}
        />
      )}
      <CommandButton
        label={t("command.withdraw")}
        primary={false}
        progress={
          order?.cancel_requested
            ? { kind: "accepted", waitingFor: vehicle.name }
            : progressOf(withdraw.asked, vehicle.name)
        }
        disabledReason={refused ?? (orderId === undefined ? t("command.no_order") : undefined)}
        onRun={withdraw.run}
      />
      <Link className="btn primary motion" to={`/send?vehicle=${encodeURIComponent(vehicle.id)}`}>
        <Icon name="send" />
        <span>{t("command.send")}</span>
      </Link>
    </>
  );
}

/** Once the report is there, the button is ready for the next command. */
function useSettled({ asked, reset }: { asked: Asked; reset: () => void }, reported: boolean): void {
  const stored = asked.kind === "stored";
  useEffect(() => {
    if (stored && reported) reset();
  }, [stored, reported, reset]);
}
