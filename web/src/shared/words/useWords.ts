import { useMemo } from "react";
import { useTranslation } from "react-i18next";
import type { ApiProblem } from "@/shared/api";
import type { MotionMode, Reason, Vehicle } from "@/shared/api/types";
import { useLoads, usePlant } from "@/shared/live";
import { actionText, type StepAction } from "./actions";
import { actorText } from "./actor";
import { closureName } from "./closures";
import { faultText } from "./faults";
import { inHandText } from "./inHand";
import { problemText, reasonText } from "./reasons";
import type { Names, Translate } from "./sentence";

export interface Words {
  names: Names;
  reason: (reason: Reason) => string;
  /** A problem in words: by its code when that is known, else the server's own sentence. */
  problem: (problem: Pick<ApiProblem, "code" | "params" | "detail">) => string;
  vehicle: (id: string) => string;
  load: (id: string) => string;
  /** Who did something: a person, or a program with a token. */
  actor: (actor: string) => string;
  /** Who drives a vehicle by hand; undefined: nobody. */
  inHand: (vehicle: Pick<Vehicle, "in_hand_of">) => string | undefined;
  fault: (type: string) => string;
  /** Name of a wheel in words, where it is one that wheels usually have. */
  wheel: (name: string) => string;
  /** The same as short as drawings need it. */
  wheelLabel: (name: string) => string;
  stationNumber: (id: string) => string;
  mode: (mode: MotionMode) => string;
  modeShort: (mode: MotionMode) => string;
  /** What a vehicle does before it leaves or when it has arrived. */
  action: (action: StepAction) => string;
}

/** Puts codes, ids and parameters of the server into words of the language shown. */
export function useWords(): Words {
  const { t: translate } = useTranslation(["common", "words", "reasons"]);
  const plant = usePlant().data;
  const allLoads = useLoads().data;
  return useMemo(() => {
    const t: Translate = (key, values) => translate(key, values ?? {});
    const vehicles = new Map((plant?.vehicles ?? []).map((v) => [v.id, v.name]));
    const stations = new Map((plant?.stations ?? []).map((s) => [s.id, String(s.number)]));
    const loads = new Map((allLoads ?? []).map((l) => [l.id, l.name]));
    const areas = new Map((plant?.areas ?? []).map((a) => [a.id, a.name]));
    const obstacles: Readonly<Record<string, string>> = {
      wall: t("words:wall"),
      map: t("words:map_obstacle"),
    };
    const ofWheel = (catalog: string, name: string) =>
      t(`alarms:${catalog}.${name.toLowerCase().replaceAll(" ", "_")}`, { defaultValue: name });
    const each = (list: string, text: (one: string) => string) =>
      list.split(", ").map(text).join(t("words:join"));
    const names: Names = {
      vehicle: (id) => vehicles.get(id) ?? areas.get(id) ?? obstacles[id],
      station: (id) => stations.get(id),
      actor: (actors) => each(actors, (one) => actorText(one, t)),
      wheel: (name) => ofWheel("wheel_name", name),
      closure: (names) => each(names, (one) => closureName(one, t)),
      load: (id) => loads.get(id),
    };
    return {
      names,
      reason: (reason) => reasonText(reason, t, names),
      problem: (problem) => problemText(problem, t, names),
      vehicle: (id) => vehicles.get(id) ?? id,
      load: (id) => loads.get(id) ?? id,
      actor: (actor) => actorText(actor, t),
      inHand: (vehicle) => inHandText(vehicle, t),
      fault: (type) => faultText(type, t),
      wheel: (name) => ofWheel("wheel_name", name),
      wheelLabel: (name) => ofWheel("wheel_label", name),
      stationNumber: (id) => stations.get(id) ?? id,
      mode: (mode) => t(`words:mode.${mode}`),
      modeShort: (mode) => t(`words:mode_short.${mode}`),
      action: (action) => actionText(action, t, names),
    };
  }, [plant, allLoads, translate]);
}
