import { useEffect, useState } from "react";
import { useTranslation } from "react-i18next";
import { useNow } from "@/shared/live";
import type { CommandProgress } from "@/shared/ui";
import { overdue } from "@/shared/ui/outcome";

/** As given, but what is under way for too long has timed out, with what to do next. */
export function useOverdue(progress: CommandProgress, who: string): CommandProgress {
  const { t } = useTranslation("commands");
  const now = useNow(500).monoMs;
  const underWay = progress.kind === "under_way";
  const [sinceMs, setSinceMs] = useState<number>();
  useEffect(() => setSinceMs(underWay ? performance.now() : undefined), [underWay]);
  return overdue(progress, sinceMs, now, {
    what: t("not_done"),
    next: t("go_there", { vehicle: who }),
  });
}
