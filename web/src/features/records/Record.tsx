import { useState } from "react";
import { useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import { Tabs } from "@/shared/ui";
import { useNarrow } from "@/shared/ui/useNarrow";
import { beginsClose, closeUpHalf, kHalves_mm, plotReach_mm, type Scale } from "./plots/closeUp";
import { RecordHead } from "./RecordHead";
import { RunCard } from "./RunCard";
import { countedStops } from "./plots/statistics";
import { TargetCard } from "./plots/TargetCard";
import { closeScale, toleranceScale } from "./plots/targetScale";
import { ThisStop } from "./ThisStop";
import { TrendCard } from "./plots/TrendCard";
import { useStopsUpTo } from "./useStopHistory";
import "./Record.css";

/** Stops that the target and the trend show, this one the last of them. */
const kLast = 30;

/** One measured stop against the drawing. */
export function Record({ stop }: { stop: StopRecord }) {
  const { t } = useTranslation("records");
  const narrow = useNarrow();
  const [tab, setTab] = useState("stop");
  const { last, failed } = useStopsUpTo(stop, kLast);
  const [wanted, setScale] = useState<Scale>();
  const counted = countedStops(last);
  const limit = 1000 * Math.max(stop.tolerance.dx_m, stop.tolerance.dy_m);
  const half = closeUpHalf(
    plotReach_mm(
      stop,
      last.filter((_, i) => counted[i]),
    ),
    limit,
    kHalves_mm,
  );
  const scale = wanted ?? (beginsClose(half, limit) ? "close" : "tolerance");
  const target = (
    <TargetCard
      stop={stop}
      last={last}
      closeUp={half === undefined ? undefined : closeScale(half)}
      tolerance={toleranceScale(stop)}
      scale={scale}
      onScale={setScale}
    />
  );
  const values = <ThisStop stop={stop} />;
  const trend = (
    <TrendCard stop={stop} last={last} slots={kLast} failed={failed} scale={scale} onScale={setScale} />
  );
  const run = <RunCard stop={stop} />;
  return (
    <>
      <RecordHead stop={stop} />
      {narrow ? (
        <div className="rectabs">
          <Tabs
            label={t("tabs.label")}
            selected={tab}
            onSelect={setTab}
            items={[
              {
                id: "stop",
                title: t("tabs.stop"),
                content: (
                  <div className="rg">
                    {target}
                    {values}
                  </div>
                ),
              },
              { id: "run", title: t("tabs.run"), content: run },
              { id: "trend", title: t("tabs.trend"), content: trend },
            ]}
          />
        </div>
      ) : (
        <div className="rg">
          {target}
          {values}
          {trend}
          {run}
        </div>
      )}
    </>
  );
}
