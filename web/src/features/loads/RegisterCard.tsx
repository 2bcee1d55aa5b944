import { useCallback } from "react";
import { useTranslation } from "react-i18next";
import type { Load } from "@/shared/api/types";
import { navigate } from "@/shared/router";
import { Card } from "@/shared/ui";
import { FactsForm } from "./FactsForm";

/** A new load, not in the plant yet; then its own page. */
export function RegisterCard({ onClose }: { onClose: () => void }) {
  const { t } = useTranslation("loads");
  const show = useCallback(
    ({ id }: Load) => navigate(`/loads/${encodeURIComponent(id)}`, { replace: true }),
    [],
  );
  return (
    <Card className="lnew" title={t("new")}>
      <FactsForm onDone={show} onCancel={onClose} />
    </Card>
  );
}
