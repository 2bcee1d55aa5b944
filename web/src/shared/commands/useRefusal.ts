import { useTranslation } from "react-i18next";
import { useCommandsEnabled, useMayCommand } from "@/shared/live";

/** Why no command can be given at all now; undefined while they can. */
export function useRefusal(): string | undefined {
  const { t } = useTranslation("commands");
  const linkUp = useCommandsEnabled();
  const may = useMayCommand();
  return !linkUp ? t("offline") : !may ? t("not_allowed") : undefined;
}
