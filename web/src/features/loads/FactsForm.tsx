import { useId } from "react";
import { useTranslation } from "react-i18next";
import type { Load } from "@/shared/api/types";
import { CommandFailed, useRefusal } from "@/shared/commands";
import { Button, CommandButton } from "@/shared/ui";
import { FactsFields } from "./FactsFields";
import { useFacts, type KnownLoad } from "./useFacts";

interface Props {
  /** Undefined: a new load. */
  known?: KnownLoad;
  onDone: (load: Load) => void;
  onCancel: () => void;
  /** Looks at the load again, where somebody else has changed it. */
  onAgain?: () => void;
}

/** What is known of a load, new or weighed anew. Nothing moves by it. */
export function FactsForm({ known, onDone, onCancel, onAgain }: Props) {
  const { t } = useTranslation("loads");
  const refused = useRefusal();
  const why = useId();
  const { draft, change, fault, wrong, command, stale } = useFacts(known, onDone);
  const { asked } = command;
  return (
    <div className="lsheet">
      <FactsFields draft={draft} known={known !== undefined} wrong={wrong} why={why} onChange={change} />
      <div id={why}>
        {stale ? (
          <div className="row" role="alert">
            <p className="lab failedline">{t("form.stale")}</p>
            <Button {...(onAgain && { onPress: onAgain })}>{t("form.again")}</Button>
          </div>
        ) : (
          <CommandFailed command={command} />
        )}
      </div>
      <div className="row lacts">
        <CommandButton
          label={t(known ? "form.save" : "form.register")}
          twoStep={false}
          progress={asked.kind === "requested" ? { kind: "requested", atMs: asked.atMs } : { kind: "ready" }}
          disabledReason={refused ?? (fault && t(`form.wrong.${fault}`))}
          onRun={command.run}
        />
        <Button quiet onPress={onCancel}>
          {t("form.cancel")}
        </Button>
      </div>
    </div>
  );
}
