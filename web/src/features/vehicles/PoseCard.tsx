import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { Card, Value } from "@/shared/ui";
import { age, fixed, heading, millimetres, secondsSince } from "@/shared/words/format";

export function PoseCard({ vehicle, now }: { vehicle: Vehicle; now: number }) {
  const { t } = useTranslation("vehicles");
  const { pose } = vehicle;
  const ageS = secondsSince(vehicle.pose_at, now) ?? "never";
  const atMs = vehicle.pose_at === undefined ? undefined : Date.parse(vehicle.pose_at);
  const shared = { ageS: pose ? ageS : ("never" as const), atMs };
  return (
    <Card
      className="pose"
      title={t("pose.title")}
      summary={t(vehicle.pose_known ? "pose.confirmed" : "pose.unknown")}
      right={ageS === "never" ? undefined : age(ageS)}
    >
      <div className="pvs">
        <Value caption={t("pose.x")} value={pose && millimetres(pose.x_m, { decimals: 2 })} unit="mm" {...shared} />
        <Value caption={t("pose.y")} value={pose && millimetres(pose.y_m, { decimals: 2 })} unit="mm" {...shared} />
        <Value
          caption={t("pose.heading")}
          value={pose && `${heading(pose.heading_rad, { sign: true })}°`}
          {...shared}
        />
        <Value
          caption={t("pose.speed")}
          value={vehicle.speed_mps === undefined ? undefined : fixed(vehicle.speed_mps, 2)}
          unit="m/s"
          {...shared}
        />
      </div>
    </Card>
  );
}
