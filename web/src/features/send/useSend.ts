import { useMemo } from "react";
import type { NewJobOrder } from "@/shared/api/types";
import { bracketsWanted, liftOf } from "@/shared/body/bracketStep";
import {
  useClosures,
  useCommandsEnabled,
  useJobOrders,
  useLoads,
  useMayCommand,
  usePlant,
  useStations,
  useVehicle,
  useVehicles,
} from "@/shared/live";
import { busyKey, busyWith } from "./busy/busy";
import { feetPlan, moveActions, previewWithFeet } from "./steps/feet";
import { codesCheck, floorCheck, withHands } from "./steps/wayChecks";
import { transferAt } from "./steps/transfer";
import { chosenOption, isOnItsWay, previewKey, readiness, sortOptions } from "./preview/preview";
import { lookUpStation, stationOf } from "./steps/stationEntry";
import { useOnScreen } from "./useOnScreen";
import { usePreview, type PreviewQuestion } from "./preview/usePreview";
import { sortForSending } from "./steps/VehicleStep";
import { useWhyNot } from "./start/whyNot";
import type { Choice } from "./useChoice";

export type Send = ReturnType<typeof useSend>;

/** What follows from the choice: what is asked of the planner, what it says, what Start would send and why it may not. */
export function useSend(choice: Choice, /** A move is watched: nothing is previewed. */ watching: boolean) {
  const { mode, digits } = choice;
  const plant = usePlant().data;
  const allVehicles = useVehicles();
  const vehicles = useMemo(() => sortForSending(allVehicles, plant), [allVehicles, plant]);
  const stations = useStations();
  const states = useMemo(() => stations.flatMap((s) => (s.state ? [s.state] : [])), [stations]);
  const orders = useJobOrders();
  const closures = useClosures();
  const loads = useLoads().data;
  const linkUp = useCommandsEnabled();
  const mayCommand = useMayCommand();
  const onScreen = useOnScreen();

  const vehicle = useVehicle(choice.vehicle ?? (vehicles.length === 1 ? vehicles[0]?.id : undefined));
  const entry = lookUpStation(digits, plant, states, vehicle);
  const station = stationOf(entry);
  const busy = busyWith(vehicle, orders);
  const park = choice.park ?? station?.parks ?? false;
  const { raise, lower } = feetPlan(vehicle, busy !== undefined, park);
  const feet = useMemo(() => ({ raise, lower }), [raise, lower]);
  const offered = transferAt(station, states, vehicle, loads ?? []);
  const transfer = offered?.key === choice.transfer ? offered : undefined;
  const type = plant?.vehicle_types.find(({ id }) => id === vehicle?.type);
  const lift = liftOf([type]);
  const brackets = bracketsWanted(choice.brackets, lift);
  const does = JSON.stringify(moveActions(feet, transfer, brackets.action));
  const actions = useMemo<ReturnType<typeof moveActions>>(() => JSON.parse(does), [does]);
  const asks =
    !watching &&
    onScreen &&
    vehicle !== undefined &&
    station !== undefined &&
    entry.kind !== "wrong_type" &&
    (busy !== undefined || !isOnItsWay(vehicle)) &&
    linkUp;
  const question: PreviewQuestion | undefined = asks
    ? {
        key: previewKey({
          vehicle: vehicle.id,
          station: station.number,
          mode,
          pose: vehicle.pose,
          link: `${vehicle.link}${vehicle.activity}${vehicle.paused}${does}`,
          stationsKey: states.map((s) => `${s.occupied_by}/${s.reserved_by}`).join(","),
          after: busyKey(busy),
        }),
        vehicle: vehicle.id,
        station: station.number,
        mode,
        actions,
      }
    : undefined;
  const asked = usePreview(question);
  const preview = useMemo(() => previewWithFeet(asked.preview, feet), [asked.preview, feet]);
  const data =
    preview.kind === "ready" ? preview.data : preview.kind === "loading" ? preview.last : undefined;
  const step = data?.steps[0];
  const chosen = chosenOption(step, mode);
  const option = chosen?.feasible ? chosen : undefined;
  const leadThere = useMemo(() => sortOptions(step?.options ?? []).filter((o) => o.feasible), [step]);
  const floor = floorCheck(option, closures, loads ?? []);
  const codes = codesCheck(option);
  const checks = data && [
    ...withHands(data.checks, vehicle),
    ...(floor ? [floor] : []),
    ...(codes ? [codes] : []),
  ];
  const ready = readiness({
    vehicle,
    entry,
    mode,
    linkUp,
    mayCommand,
    preview,
    floor,
    busy: busy !== undefined,
    brackets: brackets.fault,
  });
  const { why, instead } = useWhyNot(ready);
  const noWay = step && step.options.length > 0 && !step.options.some((o) => o.feasible);

  const body = useMemo<NewJobOrder | undefined>(
    () =>
      ready.kind === "ready" && vehicle && station && option
        ? {
            vehicle: vehicle.id,
            priority: 0,
            steps: [{ station: station.number, motion_mode: option.mode, ...actions }],
          }
        : undefined,
    [ready.kind, vehicle, station, option, actions],
  );
  return {
    plant,
    vehicles,
    vehicle,
    orders,
    entry,
    station,
    busy,
    preview,
    retry: asked.retry,
    park,
    feet,
    offered,
    transfer,
    /** Undefined: its brackets stay where they are, or it has none. */
    lift,
    type,
    raises: brackets.action,
    step,
    option,
    leadThere,
    checks,
    readiness: ready,
    why,
    instead,
    /** Why the server says that no way leads there. */
    unreachable: noWay ? step.options.find((o) => o.reason)?.reason : undefined,
    body,
  };
}
