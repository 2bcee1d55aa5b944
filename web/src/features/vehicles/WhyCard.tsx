import { useTranslation } from "react-i18next";
import type { StationState, Vehicle, VehicleType } from "@/shared/api/types";
import { useHeldWords } from "@/shared/commands";
import { alarmOf, symbolOf } from "@/shared/live";
import { Card, CheckRow, StatusSymbol } from "@/shared/ui";
import { age, fixed } from "@/shared/words/format";
import { useAlarmWords } from "@/shared/words/useAlarmWords";
import { useWords } from "@/shared/words/useWords";
import { whyRows, type WhyRow } from "./whyRows";
import "./WhyCard.css";

/** The most urgent thing about a vehicle, in one sentence: what is wrong with it, else why it stands or what it does. */
export function useAnswer(): (vehicle: Vehicle) => string {
  const { t } = useTranslation("vehicles");
  const words = useWords();
  const alarmWords = useAlarmWords();
  const held = useHeldWords();
  return (vehicle) => {
    const alarm = alarmOf(vehicle);
    if (alarm !== undefined && alarm.priority !== "low") return alarmWords.text(alarm, vehicle);
    if (vehicle.paused || vehicle.needs_resume) return held(vehicle);
    if (vehicle.activity === "moving" && vehicle.leg) {
      return vehicle.reason
        ? words.reason(vehicle.reason)
        : t("why.moving", { number: words.stationNumber(vehicle.leg.station) });
    }
    if (vehicle.activity === "measuring") return t("why.measuring");
    return vehicle.reason ? words.reason(vehicle.reason) : t("why.no_reason");
  };
}

/** What to do about that; undefined when nothing is wrong. An alarm that is no headline says what it is, too. */
function useTodo(): (vehicle: Vehicle) => string | undefined {
  const { t } = useTranslation("vehicles");
  const words = useAlarmWords();
  const answer = useAnswer();
  return (vehicle) => {
    const alarm = alarmOf(vehicle);
    if (alarm === undefined) return undefined;
    const what = words.text(alarm, vehicle);
    const todo = words.todo(alarm);
    return what === answer(vehicle) || alarm.priority !== "low" ? todo : t("why.low", { what, todo });
  };
}

export function WhyCard({
  vehicle,
  type,
  target,
  heard_s,
  stale,
}: {
  vehicle: Vehicle;
  type: VehicleType | undefined;
  target: StationState | undefined;
  heard_s: number | undefined;
  stale: boolean;
}) {
  const { t } = useTranslation("vehicles");
  const answer = useAnswer();
  const todo = useTodo()(vehicle);
  const moving = vehicle.activity === "moving" || vehicle.activity === "measuring";
  return (
    <Card
      className="why whycard"
      title={t(moving ? "why.title_moving" : "why.title", { vehicle: vehicle.name })}
    >
      <p className="ans1" role="status">
        <StatusSymbol name={symbolOf(vehicle)} />
        <span>{answer(vehicle)}</span>
      </p>
      {todo !== undefined && <p className="todo">{todo}</p>}
      {whyRows(vehicle, type, target, stale).map((row, i) => (
        <Row key={`${row.kind}${i}`} row={row} ageS={heard_s} stale={stale} />
      ))}
    </Card>
  );
}

function Row({ row, ageS, stale }: { row: WhyRow; ageS: number | undefined; stale: boolean }) {
  const { t } = useTranslation("vehicles");
  const words = useWords();
  const { name, value } = text();
  return (
    <CheckRow
      result={row.result}
      name={name}
      value={value}
      ageS={row.kind === "station" ? undefined : ageS}
      critical={row.kind === "fault"}
      stale={stale && row.kind !== "link"}
    />
  );

  function text(): { name: string; value: string } {
    switch (row.kind) {
      case "link":
        return {
          name: t("why.link"),
          value: ageS === undefined ? t("list.never") : t("why.heard", { age: age(ageS) }),
        };
      case "resume":
        return { name: t("why.resume"), value: t("why.resume_needed") };
      case "order":
        return { name: t("why.order"), value: "" };
      case "station": {
        const by = words.vehicle(row.state.occupied_by || row.state.reserved_by);
        const key = row.state.occupied_by ? "occupied" : row.state.reserved_by ? "reserved" : "free";
        return {
          name: t("why.station"),
          value: t("why.station_line", { number: row.state.number, state: t(`why.${key}`, { by }) }),
        };
      }
      case "load":
        return {
          name: t("why.load"),
          value: t("why.load_line", {
            state: row.fault ? words.reason(row.fault) : t(row.empty ? "why.no_load" : "why.balanced"),
            feet: t(row.down ? "body:loads.feet_lowered" : "body:loads.feet_raised"),
          }),
        };
      case "wheel":
        return {
          name: t("body:loads.wheel", { name: words.wheel(row.wheel.name) }),
          value: row.wheel.fault
            ? words.fault(row.wheel.fault)
            : t("why.warm", { temperature: fixed(row.wheel.temperature_c, 0) }),
        };
      case "wheels":
        return { name: t("why.wheels"), value: t("why.wheel_ok", { count: row.count }) };
      case "fault":
        return { name: t("why.fault"), value: words.fault(row.error.type) };
    }
  }
}
