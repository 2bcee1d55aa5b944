import { useCallback, useEffect, useState } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import type { Closure } from "@/shared/api/types";
import { timeOfDay } from "@/shared/words/format";
import { useClosures, useCommandsEnabled, useMayCommand } from "@/shared/live";
import type { HallModel } from "@/shared/map";
import { Button, CommandButton, type CommandProgress } from "@/shared/ui";
import { useCommand, type Asked } from "@/shared/ui/useCommand";
import { number } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { laneCount, sizeOf, toClosure, type FloorDraft } from "./floorTool";

const kNames = ["work", "obstacle", "spill", "people"] as const;

export interface FloorPanelProps {
  model: HallModel;
  draft: FloorDraft;
  onDraft: (draft: FloorDraft) => void;
  onShow: (closure: Closure) => void;
  onClose: () => void;
}

/** Closed floor: what is closed, by whom and since when; and the tool that closes more. Presses on the map choose. */
export function FloorPanel({ model, draft, onDraft, onShow, onClose }: FloorPanelProps) {
  const { t } = useTranslation(["map", "words"]);
  const words = useWords();
  const closures = useClosures();
  const refused = useRefused();
  const [name, setName] = useState<(typeof kNames)[number]>("work");
  const body = toClosure(draft, t(`words:closure.${name}`), model.hall.id);
  const text = JSON.stringify(body);
  const { asked, run, reset } = useCommand(
    useCallback(async () => {
      await call(api.POST("/api/v1/closures", { body: JSON.parse(text) }));
    }, [text]),
  );
  const stored = asked.kind === "stored";
  useEffect(() => {
    if (!stored) return;
    onDraft({ how: "lanes", edges: [], corner: undefined, area: undefined });
    reset();
  }, [stored, onDraft, reset]);
  const hint = draft.corner ? "corner" : draft.area ? "area" : draft.edges.length > 0 ? "lanes" : "none";
  return (
    <section className="tool" aria-label={t("floor.title")}>
      <header className="row">
        <h2 className="card-title grow">{t("floor.title")}</h2>
        <Button quiet onPress={onClose}>
          {t("floor.done")}
        </Button>
      </header>
      {!refused.viewer && (
        <div className="make">
          <p className="lab" role="status">
            {t(`floor.hint.${hint}`, { count: laneCount(draft.edges, model.lanes) })}
          </p>
          <div className="seg names" role="group" aria-label={t("floor.why")}>
            {kNames.map((one) => (
              <button key={one} type="button" aria-pressed={one === name} onClick={() => setName(one)}>
                {t(`words:closure.${one}`)}
              </button>
            ))}
          </div>
          <CommandButton
            label={t("floor.close")}
            progress={progressOf(asked)}
            disabledReason={refused.why ?? (body === undefined ? t("floor.choose") : undefined)}
            onRun={run}
          />
          {asked.kind === "failed" && (
            <p className="lab bad" role="alert">
              {words.problem(asked.problem)}
            </p>
          )}
        </div>
      )}
      <h3 className="grp">
        {t("floor.list")} <i>{closures.length}</i>
      </h3>
      {closures.length === 0 && <p className="lab none">{t("floor.none")}</p>}
      <ul className="closures">
        {closures.map((closure) => (
          <Row key={closure.id} closure={closure} model={model} onShow={onShow} />
        ))}
      </ul>
    </section>
  );
}

function Row({
  closure,
  model,
  onShow,
}: {
  closure: Closure;
  model: HallModel;
  onShow: (closure: Closure) => void;
}) {
  const { t } = useTranslation(["map", "words"]);
  const words = useWords();
  const refused = useRefused();
  const { id } = closure;
  const { asked, run } = useCommand(
    useCallback(() => call(api.DELETE("/api/v1/closures/{id}", { params: { path: { id } } })), [id]),
  );
  const size = sizeOf(closure, model.lanes);
  return (
    <li>
      <button type="button" className="pickstn" onClick={() => onShow(closure)}>
        <b>{closure.name}</b>
        <span className="lab">
          {size.kind === "area"
            ? t("floor.size_area", {
                x: number(size.x_m, { decimals: 1 }),
                y: number(size.y_m, { decimals: 1 }),
              })
            : t("floor.size_lanes", { count: size.count })}
        </span>
        <span className="lab">
          {t("floor.by", { by: words.actor(closure.created_by), time: timeOfDay(closure.created_at) })}
        </span>
      </button>
      {!refused.viewer && (
        <CommandButton
          label={t("floor.reopen")}
          primary={false}
          progress={progressOf(asked)}
          disabledReason={refused.why}
          onRun={run}
        />
      )}
      {asked.kind === "failed" && (
        <p className="lab bad" role="alert">
          {words.problem(asked.problem)}
        </p>
      )}
    </li>
  );
}

function progressOf(asked: Asked): CommandProgress {
  return asked.kind === "requested" ? { kind: "requested", atMs: asked.atMs } : { kind: "ready" };
}

function useRefused(): { viewer: boolean; why: string | undefined } {
  const { t } = useTranslation();
  const enabled = useCommandsEnabled();
  const may = useMayCommand();
  return { viewer: !may, why: enabled ? undefined : t("pause.offline") };
}
