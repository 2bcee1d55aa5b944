import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { useMayCommand } from "@/shared/live";
import { Link } from "@/shared/router";
import { Card, StatusSymbol, Value } from "@/shared/ui";
import { age, dateTime, fixed, heading, length, millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { lightWords, navigationWords, poseWords, reflectorWords } from "@/shared/words/poseBasis";
import type { Heard } from "./useHeard";
import "./PoseCard.css";

export function PoseCard({ vehicle, heard, now }: { vehicle: Vehicle; heard: Heard; now: number }) {
  const { t } = useTranslation("vehicles");
  const { pose, speed_mps } = heard;
  const ageS = heard.pose_s ?? "never";
  const atMs = heard.pose_s === undefined ? undefined : now - heard.pose_s * 1000;
  const shared = { ageS: pose ? ageS : ("never" as const), atMs };
  const words = useWords();
  const may = useMayCommand();
  const codes = vehicle.codes_under_way;
  const chain = vehicle.leg?.marker_chain;
  const light = lightWords(vehicle);
  const reflectors = reflectorWords(vehicle);
  const steers = navigationWords(vehicle);
  const basis = poseWords(vehicle, words.stationNumber, (at) => dateTime(at, now), words.actor);
  const since = basis.since === undefined ? t("pose.still") : t("pose.since", { length: basis.since });
  const measured = ["stop", "codes", "receivers", "reflectors"].includes(basis.key);
  // What has been driven since is reckoned, not measured.
  const symbol = !vehicle.pose_known
    ? "a-2"
    : !measured
      ? "a-3"
      : basis.since === undefined
        ? "c-ok"
        : "s-stale";
  const deviation =
    vehicle.pose_known && vehicle.pose_deviation_m !== undefined
      ? t("pose.deviation", { length: length(vehicle.pose_deviation_m) })
      : undefined;
  return (
    <Card
      className="pose"
      title={t("pose.title")}
      summary={deviation}
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
      <p className="basis" data-basis={basis.key}>
        <StatusSymbol name={symbol} />
        <span>
          {t(`pose.basis.${basis.key}`, basis.values)}
          {vehicle.pose_basis && vehicle.pose_known && `${t("join")}${since}`}
        </span>
      </p>
      {steers && (
        <p className="basis" data-steers={steers.key}>
          <StatusSymbol name={steers.whyNot ? "a-2" : steers.key === "person" ? "a-3" : "c-ok"} />
          <span>
            {t(`pose.steers.${steers.key}`)}
            {steers.since && `${t("join")}${t("pose.steers_since", { length: steers.since })}`}
            {steers.whyNot
              ? `${t("join")}${words.reason({ code: steers.whyNot, params: {} })}`
              : steers.explained && `${t("join")}${t("pose.explained", { percent: steers.explained })}`}
          </span>
        </p>
      )}
      {codes && (
        <p className="basis" data-codes={codes.read}>
          <StatusSymbol name={codes.read > 0 ? "c-ok" : "a-3"} />
          <span>{t(codes.read > 0 ? "pose.codes" : "pose.no_codes", { ...codes })}</span>
        </p>
      )}
      {chain && (
        <p className="basis" data-chain={chain.reason ? "none" : chain.markers.length}>
          <StatusSymbol name={chain.reason ? "a-3" : "c-ok"} />
          <span>
            {chain.reason
              ? words.reason(chain.reason)
              : t(chain.markers.length > 0 ? "pose.chain" : "pose.chain_direct", {
                  count: chain.markers.length,
                  last: chain.markers.at(-1)?.payload,
                  length: length(chain.arrival_sigma_m),
                })}
          </span>
        </p>
      )}
      {light && (
        <p className="basis" data-light={light.key}>
          <StatusSymbol name={light.key === "all" ? "c-ok" : light.key === "some" ? "a-3" : "a-2"} />
          <span>{t(`pose.light.${light.key}`, light.values)}</span>
        </p>
      )}
      {reflectors && (
        <p className="basis" data-reflectors={reflectors.values.seen}>
          <StatusSymbol
            name={reflectors.key === "all" ? "c-ok" : reflectors.key === "some" ? "a-3" : "a-2"}
          />
          <span>{t(`pose.reflectors.${reflectors.key}`, reflectors.values)}</span>
        </p>
      )}
      {may && (
        <Link className="btn byhand" to={`/drive/${encodeURIComponent(vehicle.id)}`}>
          {t("command.drive")}
        </Link>
      )}
    </Card>
  );
}
