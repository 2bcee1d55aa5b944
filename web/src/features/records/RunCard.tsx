import { useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import { useServerNow } from "@/shared/live";
import { Card } from "@/shared/ui";
import { degrees, millimetres } from "@/shared/words/format";
import { RunTable } from "./RunTable";
import { useRun } from "./useStopHistory";

/** All stops of the order that this one belongs to. */
export function RunCard({ stop }: { stop: StopRecord }) {
  const { t } = useTranslation("records");
  const now = useServerNow(60_000);
  const run = useRun(stop);
  const far = (f: (s: StopRecord) => number) => Math.max(...run.map(f));
  return (
    <Card
      className="runcard"
      title={t("run")}
      summary={
        run.length > 0 &&
        t("run_summary", {
          count: run.length,
          mm: millimetres(
            far((s) => Math.max(Math.abs(s.dx_m), Math.abs(s.dy_m))),
            { decimals: 2 },
          ),
          deg: degrees(far((s) => Math.abs(s.dheading_rad))),
        })
      }
      right={t("run_units")}
    >
      <div className="scroll" tabIndex={0} role="group" aria-label={t("run")}>
        <RunTable run={run} current={stop.id} now={now} />
      </div>
    </Card>
  );
}
