import { useQuery } from "@tanstack/react-query";
import { useTranslation } from "react-i18next";
import { api, callTagged } from "@/shared/api";
import { PanelFailed, PanelLoading } from "@/shared/ui";
import { FactsForm } from "./FactsForm";

/** Says anew what is known of a load, as when it has been weighed. What it is filled with is asked once, with its ETag. */
export function ChangeFacts({ id, onClose }: { id: string; onClose: () => void }) {
  const { t } = useTranslation("loads");
  const query = useQuery({
    queryKey: ["load-to-change", id],
    queryFn: () => callTagged(api.GET("/api/v1/loads/{id}", { params: { path: { id } } })),
    staleTime: Infinity,
    gcTime: 0,
  });
  const look = () => void query.refetch();
  if (query.isPending) return <PanelLoading what={t("fact.title")} />;
  if (query.isError) return <PanelFailed what={t("form.failed")} error={query.error} onRetry={look} />;
  return (
    <FactsForm
      key={query.dataUpdatedAt}
      known={query.data}
      onDone={onClose}
      onCancel={onClose}
      onAgain={look}
    />
  );
}
