import { useQueryClient } from "@tanstack/react-query";
import { useCallback } from "react";
import { useTranslation } from "react-i18next";
import { api, call } from "@/shared/api";
import { CommandFailed, useRefusal } from "@/shared/commands";
import { takeChange } from "@/shared/live";
import { navigate } from "@/shared/router";
import { CommandButton } from "@/shared/ui";
import { useCommand } from "@/shared/ui/useCommand";
import type { LiveLoad } from "./useLiveLoads";

/** A load that is not in the plant has left it for ever. */
export function RetireLoad({ load: { id, name } }: { load: LiveLoad }) {
  const { t } = useTranslation("loads");
  const refused = useRefusal();
  const queries = useQueryClient();
  const command = useCommand(
    useCallback(async () => {
      await call(api.DELETE("/api/v1/loads/{id}", { params: { path: { id } } }));
      navigate("/loads", { replace: true });
      await takeChange(queries, (known) => known.filter((one) => one.id !== id));
    }, [queries, id]),
  );
  const { asked } = command;
  return (
    <div className="lretire">
      <p className="lab">{t("retire.hint")}</p>
      <CommandButton
        label={t("retire.run", { load: name })}
        primary={false}
        progress={asked.kind === "requested" ? { kind: "requested", atMs: asked.atMs } : { kind: "ready" }}
        disabledReason={refused}
        onRun={command.run}
      />
      <CommandFailed command={command} />
    </div>
  );
}
