import { useEffect, useRef, useState } from "react";
import { useTranslation } from "react-i18next";
import { api, call, type Vehicle } from "@/shared/api";
import { CommandFailed, useHeldWords, useRefusal } from "@/shared/commands";
import { silent, useVehicles } from "@/shared/live";
import { Button, CommandButton } from "@/shared/ui";
import { useCommand, useProgress } from "@/shared/ui/useCommand";
import { resumeGroups, tickedAtFirst } from "./resumeGroups";
import "./ResumePanel.css";

/** Lists who stands by whose word; the person ticks the vehicles they have looked at and lets them go. */
export function ResumePanel({ onClose }: { onClose: () => void }) {
  const { t } = useTranslation();
  const held = useHeldWords();
  const refused = useRefusal();
  const vehicles = useVehicles();
  const groups = resumeGroups(vehicles);
  const all = groups.flatMap((g) => g.vehicles);
  const [changed, setChanged] = useState<ReadonlySet<string>>(new Set());
  const [sent, setSent] = useState<readonly string[]>([]);
  const isTicked = (v: Vehicle) => !silent(v) && changed.has(v.id) !== tickedAtFirst(v);
  const chosen = all.filter(isTicked);
  const resume = useCommand(() => {
    const names = chosen.map((v) => v.id);
    setSent(names);
    return call(api.POST("/api/v1/fleet/resume", { body: { vehicles: names } }));
  });
  const still = all.some((v) => sent.includes(v.id));
  const progress = useProgress(resume, !still, t("resume.vehicles"));

  const panel = useRef<HTMLElement>(null);
  useEffect(() => {
    const opener = document.activeElement;
    panel.current?.focus();
    return () => {
      if (opener instanceof HTMLElement) opener.focus();
    };
  }, []);
  useEffect(() => {
    if (progress.kind !== "confirmed") return;
    const timer = setTimeout(onClose, 1500);
    return () => clearTimeout(timer);
  }, [progress.kind, onClose]);

  const toggle = (id: string) =>
    setChanged((old) => {
      const next = new Set(old);
      if (!next.delete(id)) next.add(id);
      return next;
    });
  const names = chosen.length > 3 ? `${chosen.length}` : chosen.map((v) => v.name).join(t("join"));
  return (
    <aside
      ref={panel}
      tabIndex={-1}
      className="note resume"
      aria-label={t("resume.title")}
      onKeyDown={(event) => event.key === "Escape" && onClose()}
    >
      <h2>{t("resume.title")}</h2>
      <p className="lab">
        {all.length === 0 && progress.kind === "ready" ? t("resume.none") : t("resume.why")}
      </p>
      <div className="groups">
        {groups.map(({ group, vehicles: rows }) => (
          <fieldset key={group}>
            <legend>{t(`resume.group.${group}`)}</legend>
            {rows.map((v) => (
              <label key={v.id}>
                <input
                  type="checkbox"
                  checked={isTicked(v)}
                  disabled={silent(v)}
                  onChange={() => toggle(v.id)}
                />
                <span>
                  <b>{v.name}</b>
                  <span className="why">{silent(v) ? t("resume.silent") : held(v)}</span>
                </span>
              </label>
            ))}
          </fieldset>
        ))}
      </div>
      <CommandFailed command={resume} />
      <div className="foot">
        <Button onPress={onClose}>{t("resume.close")}</Button>
        <CommandButton
          label={chosen.length === 0 ? t("resume.action") : t("resume.run", { names })}
          icon="play"
          primary={false}
          direction="go"
          progress={progress}
          disabledReason={
            refused ?? (progress.kind === "ready" && chosen.length === 0 ? t("resume.choose") : undefined)
          }
          onRun={resume.run}
        />
      </div>
    </aside>
  );
}
