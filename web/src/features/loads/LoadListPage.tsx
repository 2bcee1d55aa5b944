import { useTranslation } from "react-i18next";
import { useMayCommand } from "@/shared/live";
import { navigate, useLocation } from "@/shared/router";
import { useNarrow } from "@/shared/ui/useNarrow";
import { LoadList } from "./LoadList";
import { RegisterCard } from "./RegisterCard";
import "./loads.css";

const closeForm = () => navigate("/loads", { replace: true });

/** The loads, and beside them the form of a new one (/loads?new). On a small screen one of the two. */
export function LoadListPage() {
  const { t } = useTranslation("loads");
  const may = useMayCommand();
  const narrow = useNarrow();
  const writing = useLocation().query.has("new") && may;
  if (!writing) return <LoadList mayRegister={may} />;
  const form = <RegisterCard onClose={closeForm} />;
  return narrow ? (
    <>
      <h1 className="sr-only">{t("title")}</h1>
      {form}
    </>
  ) : (
    <div className="lgrid">
      <LoadList mayRegister={false} />
      {form}
    </div>
  );
}
