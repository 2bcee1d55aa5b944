import type { Vehicle } from "@/shared/api/types";
import { haltOf } from "@/shared/live/pause";
import type { CommandProgress } from "@/shared/ui/command";
import { kConfirmMs } from "@/shared/ui/outcome";

type Translate = (key: string, values: { vehicle: string }) => string;

/**
 * What Pause shows. It never becomes its opposite: once the vehicle is to stand, the button says how far
 * that has come, by the vehicle's own reports, and takes no press.
 */
export function pauseProgress(
  v: Vehicle,
  asked: CommandProgress,
  nowMs: number,
  translate: Translate,
): CommandProgress {
  const t = (key: string) => translate(key, { vehicle: v.name });
  switch (haltOf(v)) {
    case "none":
      return asked;
    case "stands":
      return { kind: "holds", title: t("paused"), small: t("stands") };
    case "unheard":
      return { kind: "timed_out", what: t("unheard"), next: t("go_there") };
    case "stopping": {
      const since = v.pause?.at === undefined ? nowMs : Date.parse(v.pause.at);
      if (nowMs - since >= kConfirmMs)
        return { kind: "timed_out", what: t("moves_on"), next: t("stop_there") };
      const small = v.activity === "moving" ? "still_moves" : "not_said";
      return { kind: "under_way", title: t("stopping"), small: t(small) };
    }
  }
}
