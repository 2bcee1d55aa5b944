import { useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import { Card, StatusSymbol } from "@/shared/ui";
import { useWords } from "@/shared/words/useWords";
import type { Scale } from "./closeUp";
import { limitText } from "./limitText";
import { ScaleChoice } from "./ScaleChoice";
import { widerThanTolerance } from "./statistics";
import { TrendRow } from "./TrendRow";
import { trendRows, type TrendData } from "./trendRows";
import "./plots.css";
import "./TrendCard.css";

export interface TrendCardProps {
  stop: StopRecord;
  /** This stop is the last of them. */
  last: readonly StopRecord[];
  /** Places along a row. */
  slots: number;
  /** Older stops are missing because they did not load. */
  failed: boolean;
  scale: Scale;
  onScale: (scale: Scale) => void;
}

/** The last stops of a vehicle in its three deviations, and whether the vehicle can hold the tolerance. */
export function TrendCard({ stop, last, slots, failed, scale, onScale }: TrendCardProps) {
  const { t } = useTranslation("records");
  const words = useWords();
  const rows = trendRows(stop, last);
  const close = rows.filter((row) => row.closeUp !== undefined);
  return (
    <Card
      className="trds"
      title={t("trend", { count: last.length, vehicle: words.vehicle(stop.vehicle) })}
      right={close.length > 0 && <ScaleChoice scale={scale} onScale={onScale} />}
    >
      <div className="trows">
        <Key beyond={scale === "close" ? close : []} />
        {rows.map((row) => (
          <TrendRow key={row.name} row={row} close={scale === "close"} slots={slots} />
        ))}
        <Notes rows={rows} failed={failed} few={last.length < 8} />
      </div>
    </Card>
  );
}

/** What the lines mean, and which tolerances lie outside of what is drawn. */
function Key({ beyond }: { beyond: readonly TrendData[] }) {
  const { t } = useTranslation("records");
  const limits = [
    ...new Set(beyond.map((row) => `±${limitText(row.limit)}${row.unit === "mm" ? " mm" : row.unit}`)),
  ];
  return (
    <p className="trkey cap">
      <Line text={t("legend_tolerance")} look="ttol" />
      <Line text={t("legend_control")} look="tctl" />
      <span className="lg">
        <StatusSymbol name="a-2" /> {t("legend_off")}
      </span>
      {limits.length > 0 && <span>{t("beyond.rows", { limits: limits.join(t("join")) })}</span>}
    </p>
  );
}

function Line({ text, look }: { text: string; look: string }) {
  return (
    <span className="lg">
      <svg className="m" viewBox="0 0 28 10" aria-hidden="true">
        <path d="M0 5H28" className={look} />
      </svg>
      {text}
    </span>
  );
}

function Notes({ rows, failed, few }: { rows: readonly TrendData[]; failed: boolean; few: boolean }) {
  const { t } = useTranslation("records");
  const wide = rows.filter((r) => widerThanTolerance(r.data, r.limit)).map((r) => r.name);
  return (
    <>
      {wide.length > 0 && (
        <p className="trnote">
          <StatusSymbol name="a-3" />
          <span>{t("control_wide", { names: wide.join(t("join")) })}</span>
        </p>
      )}
      {failed && (
        <p className="trnote amiss" role="alert">
          <StatusSymbol name="a-2" />
          <span>{t("older_failed")}</span>
        </p>
      )}
      {!failed && few && <p className="cap">{t("too_few")}</p>}
    </>
  );
}
