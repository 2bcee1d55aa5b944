import { useCallback, useMemo, useState } from "react";
import { useTranslation } from "react-i18next";
import type { MotionMode, NewJobOrder } from "@/shared/api/types";
import {
  useCommandsEnabled,
  useClosures,
  useLive,
  useMayCommand,
  usePlant,
  useStations,
  useStopRecords,
  useVehicle,
  useVehicles,
} from "@/shared/live";
import { useLocation } from "@/shared/router";
import { PanelFailed } from "@/shared/ui";
import { useNarrow } from "@/shared/ui/useNarrow";
import { duration, number } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { ChecksStep, useChecksSummary } from "./ChecksStep";
import { ModeStep } from "./ModeStep";
import { MoveBar } from "./MoveBar";
import { MovePanel } from "./MovePanel";
import { floorCheck } from "./floorCheck";
import { capitalise, moveWords } from "./moveWords";
import { chosenOption, isOnItsWay, previewKey, readiness, sortOptions } from "./preview";
import { PreviewMap } from "./PreviewMap";
import { isLoaded } from "./previewOverlays";
import { Measures } from "./PreviewPanel";
import { moveProgress } from "./progress";
import { StartBar } from "./StartBar";
import { lookUpStation, stationOf } from "./stationEntry";
import { StationStep } from "./StationStep";
import { Step } from "./Step";
import { usePreview, type PreviewQuestion } from "./usePreview";
import { useSentOrder, useStart } from "./useStart";
import { sortForSending, usePlace, VehicleStep } from "./VehicleStep";
import { useWhyNot } from "./whyNot";
import "./SendPage.css";

const kNone: readonly never[] = [];

/** Send platform: vehicle, station, motion mode, checks, preview, two-step start, progress, result. */
export function SendPage() {
  const { t } = useTranslation("send");
  const words = useWords();
  const place = usePlace();
  const summary = useChecksSummary();
  const narrow = useNarrow();
  const { query } = useLocation();
  const plant = usePlant().data;
  const allVehicles = useVehicles();
  const vehicles = useMemo(() => sortForSending(allVehicles, plant), [allVehicles, plant]);
  const stations = useStations();
  const states = useMemo(() => stations.flatMap((s) => (s.state ? [s.state] : [])), [stations]);
  const stops = useStopRecords();
  const linkUp = useCommandsEnabled();
  const mayCommand = useMayCommand();
  const streamReady = useLive((s) => s.ready);

  const [vehicleId, setVehicleId] = useState(query.get("vehicle") ?? undefined);
  const [digits, setDigits] = useState(query.get("station") ?? "");
  const [mode, setMode] = useState<MotionMode>("auto");
  const [choosing, setChoosing] = useState(false);
  const [picking, setPicking] = useState(false);
  const [looked, setLooked] = useState<MotionMode>();
  const [openStep, setOpenStep] = useState<number>();

  const vehicle = useVehicle(vehicleId ?? (vehicles.length === 1 ? vehicles[0]?.id : undefined));
  const entry = lookUpStation(digits, plant, states, vehicle);
  const station = stationOf(entry);
  const asks =
    vehicle !== undefined &&
    station !== undefined &&
    entry.kind !== "wrong_type" &&
    !isOnItsWay(vehicle) &&
    linkUp;
  const question: PreviewQuestion | undefined = asks
    ? {
        key: previewKey({
          vehicle: vehicle.id,
          station: station.number,
          mode,
          pose: vehicle.pose,
          link: `${vehicle.link}${vehicle.activity}${vehicle.paused}`,
          stationsKey: states.map((s) => `${s.occupied_by}/${s.reserved_by}`).join(","),
        }),
        vehicle: vehicle.id,
        station: station.number,
        mode,
      }
    : undefined;
  const { preview, retry } = usePreview(question);
  const data =
    preview.kind === "ready" ? preview.data : preview.kind === "loading" ? preview.last : undefined;
  const step = data?.steps[0];
  const option = chosenOption(step, mode);
  const feasible = option?.feasible ? option : undefined;
  const leadThere = useMemo(() => sortOptions(step?.options ?? []).filter((o) => o.feasible), [step]);
  const closures = useClosures();
  const floor = floorCheck(feasible, closures);
  const checks = data && [...data.checks, ...(floor ? [floor] : [])];
  const canStart = readiness({ vehicle, entry, mode, linkUp, mayCommand, preview, floor });
  const { why, instead } = useWhyNot(canStart);

  const body = useMemo<NewJobOrder | undefined>(
    () =>
      canStart.kind === "ready" && vehicle && station && feasible
        ? {
            vehicle: vehicle.id,
            priority: 0,
            steps: [{ station: station.number, motion_mode: feasible.mode }],
          }
        : undefined,
    [canStart.kind, vehicle, station, feasible],
  );
  const start = useStart(body);
  const { command } = start;

  const orderId = command.kind === "accepted" ? command.orderId : undefined;
  const order = useSentOrder(orderId);
  const mover = useVehicle(
    order?.vehicle || (command.kind === "accepted" ? command.vehicle : "") || undefined,
  );
  const progress = moveProgress(order, mover, stops);

  const selectVehicle = useCallback((id: string) => {
    setVehicleId(id);
    setChoosing(false);
    setMode("auto");
    setOpenStep(undefined);
  }, []);
  const enter = useCallback((next: string) => {
    setDigits(next);
    setMode("auto");
  }, []);
  const pick = useCallback((stationNumber: number) => {
    setDigits(String(stationNumber));
    setMode("auto");
    setPicking(false);
    setOpenStep(undefined);
  }, []);

  const current = openStep ?? (!vehicle ? 1 : !station ? 2 : 4);
  const noWay = step && step.options.length > 0 && !step.options.some((o) => o.feasible);
  const unreachable = noWay ? step.options.find((o) => o.reason)?.reason : undefined;
  const target = order?.steps[Math.min(order.current_step, order.steps.length - 1)]?.number;
  const shownStation = orderId ? plant?.stations.find((s) => s.number === target) : station;

  const title =
    vehicle && station
      ? vehicle.load_name
        ? t("say.carries", { vehicle: vehicle.name, load: vehicle.load_name, number: station.number })
        : t("say.drives", { vehicle: vehicle.name, number: station.number })
      : t("say.choose");
  const what = feasible
    ? `${capitalise(moveWords(feasible.segments ?? [], (k, p) => t(k, p), t("words.join")))}${t("say.stop")} ${t("say.people")}`
    : "";

  const steps = (
    <>
      <div className="c1">
        <Step
          number={1}
          title={t("vehicle.title")}
          answer={vehicle && t("vehicle.answer", { vehicle: vehicle.name, where: place(vehicle) })}
          open={current === 1}
          onOpen={() => setOpenStep(1)}
        >
          <VehicleStep
            vehicles={vehicles}
            selected={vehicle}
            choosing={choosing || (narrow && openStep === 1)}
            onChoose={() => setChoosing(true)}
            onSelect={selectVehicle}
          />
        </Step>
        <Step
          number={2}
          title={t("station.title")}
          answer={station && t("station.answer", { number: station.number, place: station.name })}
          open={current === 2}
          onOpen={() => setOpenStep(2)}
          onNext={station ? () => setOpenStep(undefined) : undefined}
        >
          <StationStep
            digits={digits}
            entry={entry}
            plant={plant}
            unreachable={unreachable}
            picking={picking}
            onDigits={(next) => {
              enter(next);
              if (narrow) setOpenStep(2);
            }}
            onPick={() => setPicking((on) => !on)}
          />
        </Step>
      </div>
      <div className="c2">
        <Step
          number={3}
          title={t("mode.title")}
          answer={
            feasible &&
            t("mode.answer", { mode: words.modeShort(feasible.mode), time: duration(feasible.duration_s) })
          }
          open={current === 3}
          onOpen={() => setOpenStep(3)}
        >
          <ModeStep
            preview={preview}
            step={step}
            instead={instead}
            mode={mode}
            onLook={setLooked}
            onMode={(next) => {
              setMode(next);
              setLooked(undefined); // the row may go before the focus has left it
              setOpenStep(undefined);
            }}
          />
        </Step>
        <Step number={4} title={t("checks.title")} right={summary(checks)} open={current === 4}>
          {preview.kind === "failed" ? (
            <PanelFailed what={t("preview.failed")} error={preview.problem} onRetry={retry} />
          ) : (
            <ChecksStep preview={preview} checks={checks} instead={instead} />
          )}
        </Step>
      </div>
    </>
  );

  return (
    <>
      <h1 className="sr-only">{t("title")}</h1>
      <div className={`sgrid ${orderId ? "moving" : ""}`} data-step={current}>
        {orderId ? (
          <MovePanel order={order} vehicle={mover} progress={progress} orderId={orderId} onNew={start.done} />
        ) : (
          steps
        )}
        <section className="card c3" aria-label={t("preview.title")}>
          <header className="stp">
            {!orderId && <i aria-hidden="true">5</i>}
            <h2>{t(orderId ? "move.map" : "preview.title")}</h2>
            {!orderId && feasible?.swept_area_m2 !== undefined && (
              <span className="ans r">
                {t(isLoaded(vehicle) ? "preview.swept" : "preview.swept_bare", {
                  area: number(feasible.swept_area_m2),
                })}
              </span>
            )}
          </header>
          {plant && streamReady ? (
            <PreviewMap
              plant={plant}
              vehicle={orderId ? mover : vehicle}
              station={shownStation}
              option={orderId ? undefined : feasible}
              options={orderId ? kNone : leadThere}
              looked={looked}
              leg={orderId ? mover?.leg : undefined}
              picking={(picking || !station) && !orderId}
              onPick={pick}
            />
          ) : (
            <p className="lab pad-top">{t("preview.wait")}</p>
          )}
          {!orderId && <Measures option={feasible} step={step} station={station} plant={plant} />}
        </section>
      </div>
      {orderId ? (
        <MoveBar order={order} vehicle={mover} progress={progress} onNext={start.done} />
      ) : (
        <StartBar start={start} readiness={canStart} title={title} what={what} why={why} />
      )}
    </>
  );
}
