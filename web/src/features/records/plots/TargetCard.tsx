import { useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import { Card } from "@/shared/ui";
import { beyond, type Scale } from "./closeUp";
import { limitText } from "./limitText";
import { ScaleChoice } from "./ScaleChoice";
import type { PlotScale } from "./targetScale";
import { TargetPlot } from "./TargetPlot";

export interface TargetCardProps {
  stop: StopRecord;
  /** This stop is the last of them. */
  last: readonly StopRecord[];
  /** There is none where the tolerance's own picture is as close. */
  closeUp: PlotScale | undefined;
  tolerance: PlotScale;
  scale: Scale;
  onScale: (scale: Scale) => void;
}

/** Where the stop and those before it lie, and where their tolerance. */
export function TargetCard({ stop, last, closeUp, tolerance, scale, onScale }: TargetCardProps) {
  const { t } = useTranslation("records");
  const shown = scale === "close" && closeUp ? closeUp : tolerance;
  const x = stop.tolerance.dx_m * 1000;
  const y = stop.tolerance.dy_m * 1000;
  const outside = beyond(shown.half, { x, y });
  const limits = outside === "both" && x !== y ? "both_sides" : outside;
  return (
    <Card
      className="tgt"
      title={t("deviation")}
      summary="mm"
      right={
        closeUp && (
          <ScaleChoice
            scale={scale}
            onScale={onScale}
            close={`±${limitText(closeUp.half)} mm`}
            tolerance={`±${limitText(Math.max(x, y))} mm`}
          />
        )
      }
      flush
    >
      <p className="cap where" role="status">
        {t("frame", { count: last.length })}
        {outside !== "none" && t("join") + t(`beyond.${limits}`, { x: limitText(x), y: limitText(y) })}
      </p>
      <TargetPlot stop={stop} earlier={last.slice(0, -1)} scale={shown} />
    </Card>
  );
}
