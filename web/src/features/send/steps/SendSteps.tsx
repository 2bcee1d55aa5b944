import { useState } from "react";
import { useTranslation } from "react-i18next";
import type { MotionMode } from "@/shared/api/types";
import { BracketFields } from "@/shared/body/BracketFields";
import { emptyBrackets } from "@/shared/body/bracketStep";
import { PanelFailed } from "@/shared/ui";
import { useNarrow } from "@/shared/ui/useNarrow";
import { duration } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { ArrivalRow } from "./ArrivalRow";
import { ChecksStep, ChecksSummary } from "./ChecksStep";
import { ModeStep } from "./ModeStep";
import { StationStep } from "./StationStep";
import { Step } from "./Step";
import type { Choice } from "../useChoice";
import type { Send } from "../useSend";
import { usePlace, VehicleStep } from "./VehicleStep";

export interface SendStepsProps {
  send: Send;
  choice: Choice;
  current: number;
  /** Opens a step on a tablet; undefined: the one that comes next. */
  onOpen: (step: number | undefined) => void;
  picking: boolean;
  onPick: () => void;
  onLook: (mode: MotionMode | undefined) => void;
}

/** Steps 1 to 4: vehicle, station, mode, checks. */
export function SendSteps({ send, choice, current, onOpen, picking, onPick, onLook }: SendStepsProps) {
  const { t } = useTranslation("send");
  const words = useWords();
  const place = usePlace();
  const narrow = useNarrow();
  const [choosing, setChoosing] = useState(false);
  const { vehicle, station, option, preview, step, checks, instead, offered } = send;
  return (
    <>
      <div className="c1">
        <Step
          number={1}
          title={t("vehicle.title")}
          answer={vehicle && t("vehicle.answer", { vehicle: vehicle.name, where: place(vehicle) })}
          open={current === 1}
          onOpen={() => {
            setChoosing(true);
            onOpen(1);
          }}
        >
          <VehicleStep
            vehicles={send.vehicles}
            plant={send.plant}
            selected={vehicle}
            choosing={choosing || (narrow && current === 1)}
            onChoose={() => setChoosing(true)}
            onSelect={(id) => {
              choice.chooseVehicle(id);
              setChoosing(false);
              onOpen(undefined);
            }}
          />
        </Step>
        <Step
          number={2}
          title={t("station.title")}
          answer={station && t("station.answer", { number: station.number, place: station.name })}
          open={current === 2}
          onOpen={() => onOpen(2)}
          onNext={station ? () => onOpen(undefined) : undefined}
        >
          <StationStep
            digits={choice.digits}
            entry={send.entry}
            plant={send.plant}
            unreachable={send.unreachable}
            picking={picking}
            onDigits={(next) => {
              choice.chooseStation(next);
              if (narrow) onOpen(2);
            }}
            onPick={onPick}
          />
        </Step>
      </div>
      <div className="c2">
        <Step
          number={3}
          title={t("mode.title")}
          answer={
            option &&
            t("mode.answer", { mode: words.modeShort(option.mode), time: duration(option.duration_s) })
          }
          open={current === 3}
          onOpen={() => onOpen(3)}
        >
          <ModeStep
            preview={preview}
            step={step}
            instead={instead}
            plant={send.plant}
            mode={choice.mode}
            onLook={onLook}
            onMode={(next) => {
              choice.chooseMode(next);
              onLook(undefined); // the row may go before the focus has left it
              onOpen(undefined);
            }}
          />
          <div className="arrivals">
            {offered && (
              <ArrivalRow
                label={t(`mode.${offered.type}`, { load: words.load(offered.load) })}
                on={send.transfer !== undefined}
                onChange={(on) => choice.chooseTransfer(on ? offered.key : undefined)}
              />
            )}
            {send.lift && (
              <ArrivalRow
                label={t("mode.brackets")}
                on={choice.brackets !== undefined}
                onChange={(on) => choice.chooseBrackets(on ? emptyBrackets() : undefined)}
              />
            )}
            {send.lift && choice.brackets && (
              <BracketFields
                draft={choice.brackets}
                lift={send.lift}
                type={send.type}
                onChange={choice.chooseBrackets}
              />
            )}
            {vehicle && vehicle.parking_feet.length > 0 && (
              <ArrivalRow label={t("mode.park")} on={send.park} onChange={choice.choosePark} />
            )}
          </div>
        </Step>
        <Step
          number={4}
          title={t("checks.title")}
          right={checks && <ChecksSummary checks={checks} />}
          open={current === 4}
        >
          {preview.kind === "failed" ? (
            <PanelFailed what={t("preview.failed")} error={preview.problem} onRetry={send.retry} />
          ) : (
            <ChecksStep preview={preview} checks={checks} instead={instead} />
          )}
        </Step>
      </div>
    </>
  );
}
