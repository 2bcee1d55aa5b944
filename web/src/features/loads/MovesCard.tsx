import { useTranslation } from "react-i18next";
import { useServerNow } from "@/shared/live";
import { Button, Card, PanelEmpty, PanelFailed, PanelLoading } from "@/shared/ui";
import { dateTime } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { PlaceName } from "./PlaceName";
import { useLoadMoves, type LiveLoad } from "./useLiveLoads";

/** Where it has been, and who has put it there. */
export function MovesCard({ load }: { load: LiveLoad }) {
  const { t } = useTranslation("loads");
  const words = useWords();
  const now = useServerNow(60_000);
  const { moves, pages } = useLoadMoves(load.id);
  const title = t("moves.title");
  return (
    <Card className="lmoves" title={title} flush>
      {pages.isPending ? (
        <PanelLoading what={title} />
      ) : pages.isError && moves.length === 0 ? (
        <PanelFailed what={t("moves.failed")} error={pages.error} onRetry={() => void pages.refetch()} />
      ) : moves.length === 0 ? (
        <PanelEmpty what={t("moves.none")} when={t("moves.none_hint")} />
      ) : (
        <div className="scroll" tabIndex={0} role="group" aria-label={title}>
          <table className="rows">
            <thead>
              <tr>
                <th>{t("moves.at")}</th>
                <th>{t("moves.from")}</th>
                <th>{t("moves.to")}</th>
                <th>{t("col.by")}</th>
              </tr>
            </thead>
            <tbody>
              {moves.map((move) => (
                <tr key={move.seq}>
                  <td className="b">{dateTime(move.at, now)}</td>
                  <td data-label={t("moves.from")}>
                    <PlaceName place={move.from} />
                  </td>
                  <td data-label={t("moves.to")}>
                    <PlaceName place={move.to} />
                  </td>
                  <td data-label={t("col.by")}>
                    {move.by === undefined ? t("by_plant") : words.actor(move.by)}
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
          {pages.hasNextPage && (
            <Button disabled={pages.isFetchingNextPage} onPress={() => void pages.fetchNextPage()}>
              {t("moves.older")}
            </Button>
          )}
        </div>
      )}
    </Card>
  );
}
