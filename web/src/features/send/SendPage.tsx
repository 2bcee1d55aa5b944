import { useState } from "react";
import { useTranslation } from "react-i18next";
import type { MotionMode } from "@/shared/api/types";
import { useStopRecords, useVehicle } from "@/shared/live";
import { useLocation } from "@/shared/router";
import { useWords } from "@/shared/words/useWords";
import { BusyNote } from "./busy/BusyNote";
import { busyKey, busyWith, goesTo } from "./busy/busy";
import { MoveBar } from "./move/MoveBar";
import { MovePanel } from "./move/MovePanel";
import { capitalise, moveWords } from "./preview/moveWords";
import { PreviewCard } from "./preview/PreviewCard";
import { moveProgress } from "./move/progress";
import { SendSteps } from "./steps/SendSteps";
import { StartBar } from "./start/StartBar";
import { useChoice } from "./useChoice";
import { useSend, type Send } from "./useSend";
import { useSentOrder, useStart } from "./start/useStart";
import "./SendPage.css";

/** Send platform: vehicle, station, motion mode, checks, preview, two-step start, progress, result. */
export function SendPage() {
  const { t } = useTranslation("send");
  const choice = useChoice();
  const [picking, setPicking] = useState(false);
  const [looked, setLooked] = useState<MotionMode>();
  const [openStep, setOpenStep] = useState<number>();
  const send = useSend(choice, useLocation().query.has("order"));
  const { vehicle, station, busy, body } = send;
  const start = useStart(body && { body, after: busyKey(busy) });
  const { command } = start;

  const orderId = command.kind === "accepted" ? command.orderId : undefined;
  const order = useSentOrder(orderId);
  const asked = command.kind === "accepted" ? command.vehicle : "";
  const mover = useVehicle(order?.vehicle || order?.wanted_vehicle || asked || undefined);
  const progress = moveProgress(order, mover, useStopRecords());
  const current = openStep ?? (!vehicle ? 1 : !station ? 2 : 4);
  const say = useSentences(send);

  return (
    <>
      <h1 className="sr-only">{t("title")}</h1>
      {!orderId && busy && vehicle && (
        <BusyNote busy={busy} vehicle={vehicle} start={start} body={body} why={send.why} />
      )}
      <div className={`sgrid ${orderId ? "moving" : ""}`} data-step={orderId ? undefined : current}>
        {orderId ? (
          <MovePanel
            order={order}
            vehicle={mover}
            progress={progress}
            orderId={orderId}
            busy={busyWith(mover, send.orders, orderId)}
            replacing={start.replacing}
            onNew={start.done}
          />
        ) : (
          <SendSteps
            send={send}
            choice={choice}
            current={current}
            onOpen={setOpenStep}
            picking={picking}
            onPick={() => setPicking((on) => !on)}
            onLook={setLooked}
          />
        )}
        <PreviewCard
          send={send}
          watched={orderId ? { vehicle: mover, station: order && goesTo(order) } : undefined}
          looked={looked}
          picking={picking}
          onPick={(number) => {
            choice.chooseStation(String(number));
            setPicking(false);
            setOpenStep(undefined);
          }}
        />
      </div>
      {orderId ? (
        <MoveBar order={order} vehicle={mover} progress={progress} onNext={start.done} />
      ) : (
        <StartBar start={start} readiness={send.readiness} why={send.why} after={busy?.order.name} {...say} />
      )}
    </>
  );
}

/** What a start would do, in the words of the command bar. */
function useSentences({ vehicle, station, option, busy, entry, feet, transfer, raises }: Send) {
  const { t } = useTranslation("send");
  const words = useWords();
  if (!vehicle || !station) return { title: t("say.choose"), what: "", waits: undefined };
  const values = { vehicle: vehicle.name, load: vehicle.load_name, number: station.number };
  const does = t(vehicle.load_name ? "say.carries" : "say.drives", values);
  const moves =
    option &&
    `${capitalise(moveWords(option.segments ?? [], (k, p) => t(k, p), t("words.join")))}${t("say.stop")}`;
  return {
    title: busy ? t("say.then", { what: does, order: busy.order.name }) : does,
    what:
      moves === undefined
        ? ""
        : [
            feet.raise && t("say.raise"),
            moves,
            raises && t("say.brackets", { what: words.action(raises) }),
            transfer && t(`say.${transfer.type}`, { load: words.load(transfer.load) }),
            feet.lower && t(transfer || raises ? "say.park_then" : "say.park"),
            t("say.people"),
          ]
            .filter(Boolean)
            .join(" "),
    waits:
      entry.kind === "occupied" || entry.kind === "reserved"
        ? t(`say.waits_${entry.kind}`, { by: words.vehicle(entry.by), number: station.number })
        : undefined,
  };
}
