import { useTranslation } from "react-i18next";
import { CommandButton } from "@/shared/ui";
import { duration } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import type { useTour } from "./useTour";

/** How long a tour takes or what is wrong with it, and its command. */
export function TourFoot({ tour }: { tour: ReturnType<typeof useTour> }) {
  const { t } = useTranslation("orders");
  const words = useWords();
  const { problem, time } = tour;
  const { asked, run } = tour.command;
  const asking = tour.asking ? t("tour.asking") : "";
  const about = time === undefined ? asking : t("tour.time", { time: duration(time) });
  return (
    <>
      <div className="row tourfoot">
        <p className={problem ? "lab bad grow" : "lab grow"} role="status">
          {problem ?? about}
        </p>
        <CommandButton
          label={t("tour.create")}
          progress={asked.kind === "requested" ? { kind: "requested", atMs: asked.atMs } : { kind: "ready" }}
          disabledReason={tour.disabledReason}
          onRun={run}
        />
      </div>
      {asked.kind === "failed" && (
        <p className="lab bad" role="alert">
          {asked.problem.status === 0
            ? t("tour.again")
            : t("tour.refused", { detail: words.problem(asked.problem) })}
        </p>
      )}
    </>
  );
}
