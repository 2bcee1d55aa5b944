import { useTranslation } from "react-i18next";
import type { JobOrder, Vehicle, VehicleType } from "@/shared/api/types";
import { CommandFailed, HeldBar, useRefusal } from "@/shared/commands";
import { Link } from "@/shared/router";
import { Card, Chip, CommandButton, Icon } from "@/shared/ui";
import { useCommand, useProgress } from "@/shared/ui/useCommand";
import { useNarrow } from "@/shared/ui/useNarrow";
import { millimetres } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import type { HandHeld, HandState } from "./handHeld";
import "./NextSteps.css";

interface Props {
  vehicle: Vehicle;
  type: VehicleType | undefined;
  order: JobOrder | undefined;
  control: HandHeld;
  state: HandState;
}

/** From taking it to the order that follows: what is done, what is next, each at its place. */
export function NextSteps({ vehicle, type, order, control, state }: Props) {
  const { t } = useTranslation("drive");
  const inHand = vehicle.operating_mode !== "AUTOMATIC" || state.mine;
  const waits = vehicle.needs_resume || vehicle.paused;
  const at = state.mine ? 2 : inHand ? 1 : waits ? 4 : 1;
  const narrow = useNarrow();
  // One thing at a time where there is no room; who drives has to be able to give back.
  const step = (number: number) => ({
    "data-step": number,
    "aria-current": number === at ? ("step" as const) : undefined,
    hidden: narrow && number !== at && !(at === 2 && number === 3),
  });
  return (
    <Card className="nextsteps" title={t("steps.title", { vehicle: vehicle.name })}>
      <ol>
        <li {...step(1)}>
          <Take vehicle={vehicle} order={order} control={control} state={state} />
        </li>
        <li {...step(2)}>
          <b>{t("steps.drive")}</b>
          <span className="lab">{t("steps.drive_hint")}</span>
          <Codes vehicle={vehicle} type={type} />
        </li>
        <li {...step(3)}>
          <GiveBack vehicle={vehicle} control={control} state={state} />
        </li>
        <li {...step(4)}>
          <b>{t(order === undefined ? "steps.go_on" : "steps.go_on_order", { order: order?.name })}</b>
          {inHand ? (
            <span className="lab">{t("steps.go_on_later")}</span>
          ) : waits ? (
            <HeldBar vehicle={vehicle} />
          ) : (
            <Link className="btn" to={`/send?vehicle=${encodeURIComponent(vehicle.id)}`}>
              <Icon name="send" />
              <span>{t("steps.send")}</span>
            </Link>
          )}
        </li>
      </ol>
    </Card>
  );
}

function Take({ vehicle, order, control, state }: Omit<Props, "type">) {
  const { t } = useTranslation("drive");
  const words = useWords();
  const refused = useRefusal();
  const take = useCommand(control.take);
  const progress = useProgress(take, state.mine, vehicle.name);
  const person = state.line === "open" ? state.person : vehicle.in_hand_of;
  const who =
    person === undefined || state.mine
      ? undefined
      : person === ""
        ? t("steps.held_beside")
        : t("steps.held_by", { person: words.actor(person) });
  const off =
    refused ??
    (vehicle.link !== "live" ? t("steps.silent") : state.line !== "open" ? t("steps.no_line") : undefined);
  return (
    <>
      <CommandButton
        label={t("steps.take")}
        icon="right"
        primary={!state.mine}
        twoStep={order !== undefined}
        progress={
          state.mine ? { kind: "holds", title: t("steps.taken"), small: t("steps.taken_small") } : progress
        }
        disabledReason={state.mine ? undefined : off}
        onRun={take.run}
      />
      {who !== undefined && <span className="lab">{who}</span>}
      {!state.mine && order !== undefined && (
        <span className="lab">{t("steps.interrupts", { order: order.name })}</span>
      )}
      <CommandFailed command={take} />
    </>
  );
}

function GiveBack({ vehicle, control, state }: Pick<Props, "vehicle" | "control" | "state">) {
  const { t } = useTranslation("drive");
  const give = useCommand(control.giveBack);
  const progress = useProgress(give, !state.mine && vehicle.operating_mode === "AUTOMATIC", vehicle.name);
  return (
    <>
      <CommandButton
        label={t("steps.give_back")}
        icon="back"
        primary={state.mine && state.standing}
        twoStep={false}
        progress={progress}
        disabledReason={
          progress.kind !== "ready"
            ? undefined
            : !state.mine
              ? t("steps.not_taken")
              : !state.standing
                ? t("steps.moves")
                : undefined
        }
        onRun={give.run}
      />
      <CommandFailed command={give} />
    </>
  );
}

/** Where its cameras have to find their codes before it can be left to itself (Tang 2020, section 2, workflow a). */
function Codes({ vehicle, type }: Pick<Props, "vehicle" | "type">) {
  const { t } = useTranslation(["drive", "body"]);
  return (
    <span className="codes">
      {(type?.cameras ?? []).map(({ name }) => {
        const camera = t(`body:camera.title.${name}`, {
          defaultValue: t("body:camera.other", { name }),
        });
        const seen = vehicle.cameras.find((one) => one.name === name);
        const off = millimetres(Math.hypot(seen?.forward_m ?? 0, seen?.left_m ?? 0));
        return (
          <Chip key={name} symbol={seen?.found ? "c-ok" : "c-no"}>
            {seen?.found
              ? t("codes.found", { camera, code: seen.payload, off })
              : t("codes.none", { camera })}
          </Chip>
        );
      })}
    </span>
  );
}
