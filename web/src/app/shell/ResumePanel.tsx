import { useEffect, useState } from "react";
import { useTranslation } from "react-i18next";
import { api, ApiProblem, call, type Vehicle } from "@/shared/api";
import { silent, useCommandsEnabled, useFleet, useVehicles } from "@/shared/live";
import { Button, CommandButton, type CommandProgress } from "@/shared/ui";
import { useWords } from "@/shared/words/useWords";

const kConfirmMs = 10_000;

/** Lists who waits, and why; the person names the vehicles they have looked at and lets them move again. */
export function ResumePanel({ onClose }: { onClose: () => void }) {
  const { t } = useTranslation();
  const words = useWords();
  const fleet = useFleet();
  const enabled = useCommandsEnabled();
  const waiting = useVehicles().filter((v) => v.needs_resume || v.paused);
  const [left, setLeft] = useState<ReadonlySet<string>>(new Set());
  const [sent, setSent] = useState<readonly string[]>();
  const [progress, setProgress] = useState<CommandProgress>({ kind: "ready" });
  const [sentAt, setSentAt] = useState(0);
  const chosen = waiting.filter((v) => !left.has(v.id) && !silent(v));
  const still = waiting.filter((v) => sent?.includes(v.id)).length;

  useEffect(() => {
    if (progress.kind !== "accepted" || sent === undefined) return;
    if (still === 0 && fleet?.paused !== true) {
      setProgress({
        kind: "confirmed",
        by: t("resume.vehicles"),
        afterS: (performance.now() - sentAt) / 1000,
      });
      return;
    }
    const timer = setTimeout(
      () => setProgress({ kind: "timed_out", what: t("resume.failed"), next: t("reasons:no_answer") }),
      kConfirmMs,
    );
    return () => clearTimeout(timer);
  }, [progress.kind, sent, still, fleet?.paused, sentAt, t]);

  useEffect(() => {
    if (progress.kind !== "confirmed") return;
    const timer = setTimeout(onClose, 1500);
    return () => clearTimeout(timer);
  }, [progress.kind, onClose]);

  const run = async () => {
    const names = chosen.map((v) => v.id);
    setSent(names);
    setSentAt(performance.now());
    setProgress({ kind: "requested", atMs: performance.now() });
    try {
      await call(api.POST("/api/v1/fleet/resume", { body: { vehicles: names } }));
      setProgress({ kind: "accepted", waitingFor: t("resume.vehicles") });
    } catch (error) {
      const problem =
        error instanceof ApiProblem ? error : new ApiProblem({ status: 0, code: "unexpected_answer" });
      setProgress({ kind: "timed_out", what: t("resume.failed"), next: words.problem(problem) });
    }
  };

  const why = (v: Vehicle) =>
    silent(v)
      ? t("resume.silent")
      : v.needs_resume_reason !== undefined
        ? words.reason(v.needs_resume_reason)
        : t("resume.paused_by");
  const toggle = (id: string) =>
    setLeft((old) => {
      const next = new Set(old);
      if (!next.delete(id)) next.add(id);
      return next;
    });
  const names = chosen.length > 3 ? `${chosen.length}` : chosen.map((v) => v.name).join(", ");
  return (
    <aside
      className="note resume"
      aria-label={t("resume.title")}
      onKeyDown={(event) => event.key === "Escape" && onClose()}
    >
      <h2>{t("resume.title")}</h2>
      <p className="lab">
        {waiting.length === 0 && progress.kind === "ready" ? t("resume.none") : t("resume.why")}
      </p>
      <ul>
        {waiting.map((v) => (
          <li key={v.id}>
            <label>
              <input
                type="checkbox"
                checked={!left.has(v.id) && !silent(v)}
                disabled={silent(v)}
                onChange={() => toggle(v.id)}
              />
              <span>
                <b>{v.name}</b>
                <span className="why">{why(v)}</span>
              </span>
            </label>
          </li>
        ))}
      </ul>
      <div className="foot">
        <Button onPress={onClose}>{t("resume.close")}</Button>
        <CommandButton
          label={chosen.length === 0 ? t("resume.action") : t("resume.run", { names })}
          icon="play"
          primary={false}
          progress={progress}
          disabledReason={
            !enabled
              ? t("pause.offline")
              : progress.kind === "ready" && chosen.length === 0
                ? t("resume.choose")
                : undefined
          }
          onRun={() => void run()}
        />
      </div>
    </aside>
  );
}
