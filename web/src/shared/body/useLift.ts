import { useCallback, useEffect, useState } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { LiftCommand, Vehicle } from "@/shared/api/types";
import type { CommandProgress } from "@/shared/ui/command";
import { useCommand, useProgress, type Command } from "@/shared/ui/useCommand";
import { useWords } from "@/shared/words/useWords";

export interface Lift {
  command: Command;
  progress: CommandProgress;
}

/** A movement as it is asked for here, and how far it is, whoever asked. */
export function useLift(vehicle: Vehicle, type: LiftCommand["type"], body: LiftCommand | undefined): Lift {
  const { t } = useTranslation("body");
  const words = useWords();
  const [asked, setAsked] = useState<string>();
  const command = useCommand(
    useCallback(async () => {
      if (body === undefined) return;
      const path = { id: vehicle.id };
      const taken = await call(api.POST("/api/v1/vehicles/{id}/lifts", { params: { path }, body }));
      setAsked(taken.lift?.action_id);
    }, [vehicle.id, body]),
  );
  const { lift } = vehicle;
  const ended = lift !== undefined && lift.action_id === asked ? lift.state : undefined;
  const own = useProgress(command, ended === "done", vehicle.name);
  const { reset } = command;
  useEffect(() => {
    if (ended === "failed") reset(); // why stands below
  }, [ended, reset]);
  if (lift?.state !== "under_way" || lift.type !== type) return { command, progress: own };
  const small = t("lifts.for", { actor: words.actor(lift.by) });
  return { command, progress: { kind: "under_way", title: t("lifts.moves"), small } };
}
