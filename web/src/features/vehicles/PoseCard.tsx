import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { Card, Value } from "@/shared/ui";
import { age, fixed, heading, millimetres } from "@/shared/words/format";
import type { Heard } from "./useHeard";

export function PoseCard({ vehicle, heard, now }: { vehicle: Vehicle; heard: Heard; now: number }) {
  const { t } = useTranslation("vehicles");
  const { pose, speed_mps } = heard;
  const ageS = heard.pose_s ?? "never";
  const atMs = heard.pose_s === undefined ? undefined : now - heard.pose_s * 1000;
  const shared = { ageS: pose ? ageS : ("never" as const), atMs };
  return (
    <Card
      className="pose"
      title={t("pose.title")}
      summary={t(vehicle.pose_known ? "pose.confirmed" : "pose.unknown")}
      right={ageS === "never" ? undefined : age(ageS)}
    >
      <div className="pvs">
        <Value
          caption={t("pose.x")}
          value={pose && millimetres(pose.x_m, { decimals: 2 })}
          unit="mm"
          {...shared}
        />
        <Value
          caption={t("pose.y")}
          value={pose && millimetres(pose.y_m, { decimals: 2 })}
          unit="mm"
          {...shared}
        />
        <Value
          caption={t("pose.heading")}
          value={pose && `${heading(pose.heading_rad, { sign: true })}°`}
          {...shared}
        />
        <Value
          caption={t("pose.speed")}
          value={speed_mps === undefined ? undefined : fixed(speed_mps, 2)}
          unit="m/s"
          {...shared}
        />
      </div>
    </Card>
  );
}
