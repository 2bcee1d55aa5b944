import { useTranslation } from "react-i18next";
import type { JobOrder, StopRecord, Vehicle } from "@/shared/api/types";
import { HeldBar } from "@/shared/commands";
import { Link } from "@/shared/router";
import { Button, DeviationBar, StatusSymbol } from "@/shared/ui";
import { degrees, millimetres } from "@/shared/words/format";
import { useExpected } from "@/shared/words/useExpected";
import { useWords } from "@/shared/words/useWords";
import type { Busy } from "../busy/busy";
import { reached, type Milestone, type MoveProgress } from "./progress";
import type { Replacing } from "../busy/replacing";
import { endedBy } from "../busy/useBusyWords";
import { WaitsBehind } from "../busy/WaitsBehind";
import "./MovePanel.css";

const milestones: readonly Milestone[] = ["requested", "accepted", "confirmed", "arrived"];

export interface MovePanelProps {
  order: JobOrder | undefined;
  vehicle: Vehicle | undefined;
  progress: MoveProgress;
  orderId: string;
  /** What its vehicle has to do besides. */
  busy: Busy | undefined;
  replacing: Replacing;
  onNew: () => void;
}

/** The move under way, from the server's order and the vehicle's own reports only. */
export function MovePanel(props: MovePanelProps) {
  const { order, vehicle, progress, orderId, busy, replacing, onNew } = props;
  const { t } = useTranslation("send");
  const words = useWords();
  const step = order?.steps[Math.min(order.current_step, order.steps.length - 1)];
  const name = order?.name ?? "";
  const vehicleName = order?.vehicle ? words.vehicle(order.vehicle) : (vehicle?.name ?? "");
  const done = reached(progress);
  const expected = useExpected().clock(order?.expected_at);
  return (
    <section className="card move" aria-label={t("move.steps")}>
      <header>
        <h2>{t("move.title", { order: name, vehicle: vehicleName, number: step?.number ?? "" })}</h2>
        <span className="grow" />
        {expected !== undefined && progress.kind !== "arrived" && progress.kind !== "aborted" && (
          <span className="cap nw">{t("move.expected", { time: expected })}</span>
        )}
      </header>
      <div className="in">
        <ol className="miles">
          {milestones.map((m) => (
            <li key={m} className={done.includes(m) ? "done" : ""} data-done={done.includes(m)}>
              <span className="dot">{done.includes(m) && <StatusSymbol name="c-ok" />}</span>
              <span>{t(`move.${m}`, { order: name, vehicle: vehicleName })}</span>
            </li>
          ))}
        </ol>
        <p className="now" role="status">
          <StatusSymbol name={nowSymbol(progress, order)} />
          <span>{sentence()}</span>
        </p>
        {(progress.kind === "moving" || progress.kind === "measuring") && (
          <Bar
            progress={progress.kind === "moving" ? progress.progress : 1}
            granted={progress.kind === "moving" ? progress.granted : 1}
          />
        )}
        {progress.kind === "arrived" && <Arrival stop={progress.stop} />}
        {vehicle && <WaitsBehind order={order} vehicle={vehicle} busy={busy} replacing={replacing} />}
        {vehicle && <HeldBar vehicle={vehicle} />}
        <p className="lab next">{next()}</p>
        <div className="row links">
          <Link className="btn" to={`/orders/${orderId}`}>
            {t("move.to_order")}
          </Link>
          {progress.kind !== "arrived" && progress.kind !== "aborted" && (
            <Button onPress={onNew}>{t("move.back")}</Button>
          )}
          {order?.vehicle && (
            <Link className="btn" to={`/vehicles/${encodeURIComponent(order.vehicle)}`}>
              {t("move.to_vehicle")}
            </Link>
          )}
          {progress.kind === "arrived" && progress.stop && (
            <Link className="btn" to={`/records/${progress.stop.id}`}>
              {t("move.to_record")}
            </Link>
          )}
        </div>
      </div>
    </section>
  );

  function sentence(): string {
    const reason = order?.reason ?? vehicle?.reason;
    switch (progress.kind) {
      case "stored":
        return order?.reason ? words.reason(order.reason) : t("move.stored");
      case "assigned":
        return reason ? words.reason(reason) : t("move.assigned", { vehicle: vehicleName });
      case "cancelling": {
        const by = order && endedBy(order);
        return t(by === undefined ? "move.cancelling_plain" : "move.cancelling", {
          by,
          vehicle: vehicleName,
        });
      }
      case "paused":
        return order?.reason ? words.reason(order.reason) : t("move.paused");
      case "held":
        return reason ? t("move.held", { why: words.reason(reason) }) : t("move.held_plain");
      case "aborted":
        return order?.reason
          ? t("move.aborted", { why: words.reason(order.reason) })
          : t("move.aborted_plain");
      case "arrived":
        return progress.stop ? t(progress.stop.inside ? "move.inside" : "move.outside") : t("move.arrived");
      default:
        return t(`move.${progress.kind}`);
    }
  }
  function next(): string {
    if (progress.kind === "held")
      return t(vehicle?.paused || vehicle?.needs_resume ? "move.next_held" : "move.next_order");
    if (progress.kind === "aborted") return t("move.next_aborted");
    if (progress.kind === "arrived" && progress.stop && !progress.stop.inside) return t("move.next_outside");
    return "";
  }
}

function nowSymbol(progress: MoveProgress, order: JobOrder | undefined) {
  switch (progress.kind) {
    case "moving":
      return "s-moving";
    case "measuring":
      return "s-measure";
    case "held":
    case "aborted":
      return "a-2";
    case "arrived":
      return progress.stop && !progress.stop.inside ? "a-2" : "c-ok";
    default:
      return order ? "s-wait" : "s-stale";
  }
}

function Bar({ progress, granted }: { progress: number; granted: number }) {
  const { t } = useTranslation("send");
  const percent = (v: number) => Math.round(v * 100);
  return (
    <div className="waybar">
      <div
        role="progressbar"
        aria-label={t("move.progress")}
        aria-valuenow={percent(progress)}
        aria-valuemin={0}
        aria-valuemax={100}
        className="way"
      >
        <i className="grantpart" style={{ width: `${percent(granted)}%` }} />
        <i className="drivenpart" style={{ width: `${percent(progress)}%` }} />
      </div>
      <div className="row">
        <span className="cap">{t("move.driven", { percent: percent(progress) })}</span>
        <span className="grow" />
        <span className="cap">{t("move.granted", { percent: percent(granted) })}</span>
      </div>
    </div>
  );
}

function Arrival({ stop }: { stop: StopRecord | undefined }) {
  const { t } = useTranslation("send");
  if (!stop) return <p className="lab">{t("move.no_record")}</p>;
  const { tolerance } = stop;
  return (
    <div className="arrival">
      <DeviationBar
        name="dx"
        text={millimetres(stop.dx_m, { decimals: 2, sign: true })}
        unit="mm"
        value={stop.dx_m}
        limit={tolerance.dx_m}
        limitText={millimetres(tolerance.dx_m)}
      />
      <DeviationBar
        name="dy"
        text={millimetres(stop.dy_m, { decimals: 2, sign: true })}
        unit="mm"
        value={stop.dy_m}
        limit={tolerance.dy_m}
        limitText={millimetres(tolerance.dy_m)}
      />
      <DeviationBar
        name="dθ"
        text={`${degrees(stop.dheading_rad, { sign: true })}°`}
        value={stop.dheading_rad}
        limit={tolerance.dheading_rad}
        limitText={degrees(tolerance.dheading_rad, { decimals: 1 })}
      />
    </div>
  );
}
