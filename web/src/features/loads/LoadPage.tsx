import { useTranslation } from "react-i18next";
import { Link } from "@/shared/router";
import { Card, Chip, PanelEmpty, PanelFailed, PanelLoading } from "@/shared/ui";
import { mass } from "@/shared/words/format";
import { FactsCard } from "./FactsCard";
import { LoadDrawing } from "./LoadDrawing";
import { MovesCard } from "./MovesCard";
import { useLiveLoads, type LiveLoad } from "./useLiveLoads";
import { WhereCard } from "./WhereCard";
import "./loads.css";

/** One load, or the words that there is none of that name. */
export function LoadPage({ id }: { id: string }) {
  const { t } = useTranslation("loads");
  const { loads, pending, failed, again } = useLiveLoads();
  const load = loads.find((one) => one.id === id);
  if (load) return <Detail load={load} />;
  if (pending) return <PanelLoading what={id} />;
  return (
    <Card>
      <h1 className="sr-only">{t("title")}</h1>
      {failed ? (
        <PanelFailed what={t("failed")} error={failed} onRetry={again} />
      ) : (
        <PanelEmpty
          what={t("not_found", { id: id.slice(0, 64) })}
          when={t("not_found_hint")}
          action={
            <Link className="btn" to="/loads">
              {t("to_list")}
            </Link>
          }
        />
      )}
    </Card>
  );
}

/** To scale, where it is, what is known of it, and where it has been. */
function Detail({ load }: { load: LiveLoad }) {
  const { t } = useTranslation("loads");
  return (
    <>
      <div className="card head lhead">
        <div>
          <h1>{load.name}</h1>
          <span className="lab nw">
            {[t(`kind.${load.kind}`), load.model].filter(Boolean).join(t("join"))}
          </span>
        </div>
        <div className="chips">
          <Chip>{load.mass_kg > 0 ? mass(load.mass_kg) : t("not_weighed")}</Chip>
        </div>
        <div className="grow" />
        <Link className="btn" to="/loads">
          {t("to_list")}
        </Link>
      </div>
      <div className="lgrid">
        <LoadDrawing load={load} />
        <div className="lside">
          <WhereCard load={load} />
          <FactsCard load={load} />
          <MovesCard load={load} />
        </div>
      </div>
    </>
  );
}
