import { useCallback } from "react";
import { api, call } from "@/shared/api";
import type { LoadPlace } from "@/shared/api/types";
import type { CommandProgress } from "@/shared/ui/command";
import { useCommand, useProgress, type Command } from "@/shared/ui/useCommand";

/** A person says where a load is; `there`: the stream has it there. Nothing moves by it. */
export function usePlaceLoad(
  id: string,
  place: LoadPlace | undefined,
  there: boolean,
  /** Whose answer it waits for. */
  who: string,
): { command: Command; progress: CommandProgress } {
  const { vehicle, station } = place ?? {};
  const known = place !== undefined;
  const command = useCommand(
    useCallback(async () => {
      if (!known) return;
      const body: LoadPlace = vehicle !== undefined ? { vehicle } : station !== undefined ? { station } : {};
      await call(api.PUT("/api/v1/loads/{id}/place", { params: { path: { id } }, body }));
    }, [id, known, vehicle, station]),
  );
  return { command, progress: useProgress(command, there, who) };
}
