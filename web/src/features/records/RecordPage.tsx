import { useState } from "react";
import { useTranslation } from "react-i18next";
import { ApiProblem } from "@/shared/api";
import type { StopRecord } from "@/shared/api/types";
import { usePlant, useServerNow } from "@/shared/live";
import { Link } from "@/shared/router";
import {
  Card,
  DeviationBar,
  Icon,
  PanelEmpty,
  PanelFailed,
  PanelLoading,
  StatusSymbol,
  Tabs,
} from "@/shared/ui";
import { useNarrow } from "@/shared/ui/useNarrow";
import { dateTime, degrees, mass, millimetres, number } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { RunTable } from "./RunTable";
import { countedStops, series, widerThanTolerance } from "./statistics";
import { TargetPlot } from "./TargetPlot";
import { TrendRow } from "./Trend";
import { limitDecimals } from "./trendScale";
import { useRun, useStop, useStopsUpTo } from "./useStopHistory";

const kTrend = 30;

/** One measured stop against the drawing. */
export function RecordPage({ id }: { id: string }) {
  const { t } = useTranslation("records");
  const { stop, query } = useStop(id);
  if (stop) return <Record stop={stop} />;
  if (query.isPending) return <PanelLoading what={t("title")} />;
  const gone = query.error instanceof ApiProblem && query.error.status === 404;
  return (
    <Card>
      {gone ? (
        <PanelEmpty
          what={t("not_found")}
          action={
            <Link className="btn" to="/records">
              {t("back")}
            </Link>
          }
        />
      ) : (
        <PanelFailed what={t("failed")} error={query.error} onRetry={() => void query.refetch()} />
      )}
    </Card>
  );
}

function Record({ stop }: { stop: StopRecord }) {
  const { t } = useTranslation("records");
  const words = useWords();
  const narrow = useNarrow();
  const now = useServerNow(60_000);
  const [tab, setTab] = useState("stop");
  const plant = usePlant().data;
  const run = useRun(stop);
  const { last, failed } = useStopsUpTo(stop, kTrend);
  const load = plant?.vehicles.find((v) => v.id === stop.vehicle)?.load_name ?? "";
  const said = {
    vehicle: words.vehicle(stop.vehicle),
    number: stop.number,
    time: dateTime(stop.at, now),
    load,
  };
  const target = (
    <Card
      className="tgt"
      title={t("deviation")}
      summary="mm"
      right={t("frame", { count: last.length })}
      flush
    >
      <TargetPlot stop={stop} earlier={last.slice(0, -1)} />
    </Card>
  );
  const values = <ThisStop stop={stop} />;
  const trend = <TrendCard stop={stop} last={last} failed={failed} vehicle={said.vehicle} />;
  const far = (f: (s: StopRecord) => number) => Math.max(...run.map(f));
  const runCard = (
    <Card
      className="runcard"
      title={t("run")}
      summary={
        run.length > 0 &&
        t("run_summary", {
          count: run.length,
          mm: millimetres(
            far((s) => Math.max(Math.abs(s.dx_m), Math.abs(s.dy_m))),
            { decimals: 2 },
          ),
          deg: degrees(far((s) => Math.abs(s.dheading_rad))),
        })
      }
      right={t("run_units")}
    >
      <div className="scroll" tabIndex={0} role="group" aria-label={t("run")}>
        <RunTable run={run} current={stop.id} now={now} />
      </div>
    </Card>
  );
  return (
    <>
      <div className="card head">
        <Verdict inside={stop.inside} />
        <div className="grow">
          <h1>{t(stop.inside ? "inside_title" : "outside_title")}</h1>
          <span className="lab">
            {t(stop.load_kg > 0 && load ? "said_load" : "said", said)}
            <span className="gt-sm">
              {t("join")}
              {t("how", { mode: words.mode(stop.mode), attempt: stop.attempt })}
            </span>
          </span>
          <div className="lab lt-sm">{t("how", { mode: words.mode(stop.mode), attempt: stop.attempt })}</div>
        </div>
        <Link
          className="btn motion"
          to={`/send?vehicle=${encodeURIComponent(stop.vehicle)}&station=${stop.number}`}
        >
          {t("again")}
        </Link>
        <Link className="btn primary motion" to={`/send?vehicle=${encodeURIComponent(stop.vehicle)}`}>
          <Icon name="send" />
          <span>{t("next")}</span>
        </Link>
      </div>
      {narrow ? (
        <div className="vtabs">
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
              { id: "run", title: t("tabs.run"), content: runCard },
              { id: "trend", title: t("tabs.trend"), content: trend },
            ]}
          />
        </div>
      ) : (
        <div className="rg">
          {target}
          {values}
          {trend}
          {runCard}
        </div>
      )}
    </>
  );
}

function Verdict({ inside }: { inside: boolean }) {
  if (!inside) return <StatusSymbol name="a-2" size={56} className="okb" />;
  return (
    <svg className="okb" viewBox="0 0 48 48" aria-hidden="true">
      <circle cx="24" cy="24" r="22" fill="var(--solid)" />
      <path d="M13 25L21 33L36 16" fill="none" stroke="var(--on-solid)" strokeWidth="4.5" />
    </svg>
  );
}

function ThisStop({ stop }: { stop: StopRecord }) {
  const { t } = useTranslation(["records", "words"]);
  const { tolerance: tol } = stop;
  const deg = (rad: number) => (rad * 180) / Math.PI;
  const limitText = (limit: number) => number(limit, { decimals: limitDecimals(limit) });
  const same = tol.dx_m === tol.dy_m;
  return (
    <Card
      className="devs"
      title={t("this")}
      right={t(same ? "tolerance" : "tolerance_xy", {
        x: limitText(tol.dx_m * 1000),
        y: limitText(tol.dy_m * 1000),
        deg: limitText(deg(tol.dheading_rad)),
      })}
    >
      <DeviationBar
        name="dx"
        value={stop.dx_m * 1000}
        limit={tol.dx_m * 1000}
        limitText={limitText(tol.dx_m * 1000)}
        text={millimetres(stop.dx_m, { decimals: 2, sign: true })}
        unit="mm"
      />
      <DeviationBar
        name="dy"
        value={stop.dy_m * 1000}
        limit={tol.dy_m * 1000}
        limitText={limitText(tol.dy_m * 1000)}
        text={millimetres(stop.dy_m, { decimals: 2, sign: true })}
        unit="mm"
      />
      <DeviationBar
        name="dθ"
        value={deg(stop.dheading_rad)}
        limit={deg(tol.dheading_rad)}
        limitText={limitText(deg(tol.dheading_rad))}
        text={`${degrees(stop.dheading_rad, { sign: true })}°`}
      />
      <dl>
        <dt>{t("measured_by")}</dt>
        <dd>{t(`words:method.${stop.method}`, { defaultValue: stop.method.replaceAll("_", " ") })}</dd>
        <dt>{t("codes")}</dt>
        <dd>{stop.markers.join(t("join")) || "\u2013"}</dd>
        <dt>{t("uncertainty")}</dt>
        <dd>
          ±{millimetres(stop.sigma_xy_m, { decimals: 2 })} mm, ±{degrees(stop.sigma_heading_rad)}°
        </dd>
        <dt>{t("in_station")}</dt>
        <dd>
          {t(stop.along_m >= 0 ? "along_ahead" : "along_back", {
            along: number(Math.abs(stop.along_m * 1000), { decimals: 2 }),
          })}
          {t("join")}
          {t(stop.left_m >= 0 ? "left" : "right", {
            left: number(Math.abs(stop.left_m * 1000), { decimals: 2 }),
          })}
        </dd>
        {stop.arrival && (
          <>
            <dt>{t("arrival")}</dt>
            <dd>
              {t("arrival_off", {
                off: millimetres(Math.hypot(stop.arrival.dx_m, stop.arrival.dy_m), { decimals: 1 }),
                heading: degrees(Math.abs(stop.arrival.dheading_rad)),
              })}
            </dd>
          </>
        )}
        <dt>{t("load")}</dt>
        <dd>{mass(stop.load_kg)}</dd>
        <dt>{t("order")}</dt>
        <dd>
          <Link className="inline" to={`/orders/${stop.order}`}>
            {t("show_order")}
          </Link>
        </dd>
      </dl>
    </Card>
  );
}

function TrendCard({
  stop,
  last,
  failed,
  vehicle,
}: {
  stop: StopRecord;
  last: readonly StopRecord[];
  /** Older stops are missing because they did not load. */
  failed: boolean;
  vehicle: string;
}) {
  const { t } = useTranslation("records");
  const deg = 180 / Math.PI;
  const counted = countedStops(last);
  const rows = [
    {
      name: "dx",
      unit: "mm",
      limit: stop.tolerance.dx_m * 1000,
      values: last.map((s) => s.dx_m * 1000),
    },
    {
      name: "dy",
      unit: "mm",
      limit: stop.tolerance.dy_m * 1000,
      values: last.map((s) => s.dy_m * 1000),
    },
    {
      name: "dθ",
      unit: "°",
      limit: stop.tolerance.dheading_rad * deg,
      values: last.map((s) => s.dheading_rad * deg),
    },
  ].map((row) => ({ ...row, data: series(row.values, counted) }));
  const wide = rows.filter((r) => widerThanTolerance(r.data, r.limit)).map((r) => r.name);
  return (
    <Card
      className="trds"
      title={t("trend", { count: last.length, vehicle })}
      right={
        <>
          <Legend text={t("legend_tolerance")} look="ttol" />
          <Legend text={t("legend_control")} look="tctl" />
          <span className="lg">
            <StatusSymbol name="a-2" /> {t("legend_off")}
          </span>
        </>
      }
    >
      <div className="tin_">
        {rows.map((row) => (
          <TrendRow
            key={row.name}
            name={row.name}
            unit={row.unit}
            data={row.data}
            limit={row.limit}
            slots={kTrend}
          />
        ))}
        {wide.length > 0 && (
          <p className="note_">
            <StatusSymbol name="a-3" />
            <span>{t("control_wide", { names: wide.join(", ") })}</span>
          </p>
        )}
        {failed && (
          <p className="note_ amiss" role="alert">
            <StatusSymbol name="a-2" />
            <span>{t("older_failed")}</span>
          </p>
        )}
        {!failed && last.length < 8 && <p className="cap">{t("too_few")}</p>}
      </div>
    </Card>
  );
}

function Legend({ text, look }: { text: string; look: string }) {
  return (
    <span className="lg">
      <svg className="m" viewBox="0 0 28 10" aria-hidden="true">
        <path d="M0 5H28" className={look} />
      </svg>
      {text}
    </span>
  );
}
