import { useTranslation } from "react-i18next";
import { useServerNow } from "@/shared/live";
import { Link, navigate } from "@/shared/router";
import { Button, Card, PanelEmpty, PanelFailed, PanelLoading } from "@/shared/ui";
import { dateTime, kNone, mass } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { PlaceName } from "./PlaceName";
import { useLiveLoads, type LiveLoad } from "./useLiveLoads";

/** What vehicles carry: each with where it is, since when and by whom. */
export function LoadList({ mayRegister }: { mayRegister: boolean }) {
  const { t } = useTranslation("loads");
  const { loads, pending, failed, again } = useLiveLoads();
  const on = loads.filter(({ place }) => place.vehicle !== undefined).length;
  return (
    <Card
      className="listpage llist"
      level={1}
      title={t("title")}
      {...(!pending && loads.length > 0 && { summary: t("summary", { on, total: loads.length }) })}
      right={
        mayRegister && (
          <Button icon="plus" primary onPress={() => navigate("/loads?new")}>
            {t("new")}
          </Button>
        )
      }
      flush
    >
      {failed ? (
        <PanelFailed what={t("failed")} error={failed} onRetry={again} />
      ) : pending ? (
        <PanelLoading what={t("title")} />
      ) : loads.length === 0 ? (
        <PanelEmpty what={t("empty")} when={t("empty_hint")} />
      ) : (
        <div className="scroll" tabIndex={0} role="group" aria-label={t("title")}>
          <table className="rows lrows">
            <thead>
              <tr>
                <th>{t("col.load")}</th>
                <th>{t("col.kind")}</th>
                <th>{t("col.model")}</th>
                <th className="n">{t("col.mass")}</th>
                <th className="lplace">{t("col.where")}</th>
                <th>{t("col.since")}</th>
                <th>{t("col.by")}</th>
              </tr>
            </thead>
            <tbody>
              {loads.map((load) => (
                <Row key={load.id} load={load} />
              ))}
            </tbody>
          </table>
        </div>
      )}
    </Card>
  );
}

function Row({ load }: { load: LiveLoad }) {
  const { t } = useTranslation("loads");
  const words = useWords();
  const now = useServerNow(60_000);
  const to = `/loads/${encodeURIComponent(load.id)}`;
  const by = load.told?.by;
  return (
    <tr className="go" onClick={() => navigate(to)}>
      <td className="b">
        <Link className="cell-link" to={to} onClick={(event) => event.stopPropagation()}>
          {load.name}
        </Link>
      </td>
      <td>{t(`kind.${load.kind}`)}</td>
      <td>{load.model ?? ""}</td>
      <td className="n" data-label={t("col.mass")}>
        {load.mass_kg > 0 ? mass(load.mass_kg) : kNone}
      </td>
      <td className="lplace" data-label={t("col.where")}>
        <PlaceName place={load.place} />
      </td>
      <td data-label={t("col.since")}>{load.told ? dateTime(load.told.since, now) : ""}</td>
      <td>{load.told && (by === undefined ? t("by_plant") : words.actor(by))}</td>
    </tr>
  );
}
