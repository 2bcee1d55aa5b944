import { useTranslation } from "react-i18next";
import type { JobOrder, Vehicle } from "@/shared/api/types";
import { CancelOrder, PauseVehicle } from "@/shared/commands";
import { Button } from "@/shared/ui";
import { orderStateKey } from "@/shared/words/orderState";
import type { MoveProgress } from "./progress";
import "../start/CommandBar.css";
import { useWords } from "@/shared/words/useWords";

export interface MoveBarProps {
  order: JobOrder | undefined;
  vehicle: Vehicle | undefined;
  progress: MoveProgress;
  onNext: () => void;
}

/** Command bar of a move that is watched: what makes it stand, and after it the way to the next. */
export function MoveBar({ order, vehicle, progress, onNext }: MoveBarProps) {
  const { t } = useTranslation(["send", "words"]);
  const words = useWords();
  const over = progress.kind === "arrived" || progress.kind === "aborted";
  return (
    <div className="card confirm">
      <div className="grow say">
        <strong>{order?.name ?? ""}</strong>
        <span className="lab">
          {order
            ? t("move.state", { state: t(orderStateKey(order)), by: words.actor(order.created_by) })
            : ""}
        </span>
      </div>
      {over ? (
        <Button motion className="go" onPress={onNext}>
          {t("start.next")}
        </Button>
      ) : (
        <>
          {vehicle && <PauseVehicle vehicle={vehicle} />}
          <CancelOrder order={order} />
        </>
      )}
    </div>
  );
}
