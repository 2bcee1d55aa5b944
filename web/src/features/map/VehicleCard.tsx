import { useEffect, useMemo, useRef } from "react";
import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { PauseVehicle } from "@/shared/commands";
import {
  alarmOf,
  stale,
  symbolOf,
  useHeard,
  useJobOrder,
  useLink,
  useLive,
  useMayCommand,
  useServerNow,
} from "@/shared/live";
import { Link } from "@/shared/router";
import { Button, Icon, StatusSymbol } from "@/shared/ui";
import { age, timeOfDay } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import { VehicleFacts } from "./VehicleFacts";
import "./VehicleCard.css";
import { useVehicleWords } from "./vehicleWords";
import { WaitsFor } from "./WaitsFor";

export interface VehicleCardProps {
  vehicle: Vehicle;
  numberOf: (station: string) => string | undefined;
  /** Chosen in the list, not on the map: the keyboard goes on from here. */
  takesFocus: boolean;
  onSelect: (vehicle: string) => void;
  onClose: () => void;
}

/**
 * The pressed vehicle: what it does, what is wrong with it or whom it waits for, and what can be done. It stands
 * beside the drawing, never on it, so that it hides neither this vehicle nor another.
 */
export function VehicleCard({ vehicle: v, numberOf, takesFocus, onSelect, onClose }: VehicleCardProps) {
  const { t } = useTranslation("map");
  const words = useWords();
  const vehicles = useLive((s) => s.vehicles);
  const order = useJobOrder(v.order);
  const { doing, why, todo } = useVehicleWords(numberOf, vehicles)(v, order);
  const may = useMayCommand();
  const heard = useHeard(v);
  const link = useLink();
  const now = useServerNow(500);
  const lost = link.state.kind === "lost";
  const old = lost || stale(v);
  const alarm = alarmOf(v);
  const hand = words.inHand(v);
  const card = useRef<HTMLElement>(null);
  useEffect(() => {
    if (takesFocus) card.current?.focus({ preventScroll: true });
  }, [v.id, takesFocus]);
  const asOf = lost ? now - (link.ageS ?? 0) * 1000 : now - (heard.heard_s ?? 0) * 1000;
  const to = useMemo(() => encodeURIComponent(v.id), [v.id]);
  return (
    <section
      ref={card}
      className={`vcard ${old ? "old" : ""}`}
      aria-label={t("card.label", { vehicle: v.name })}
      tabIndex={-1}
      onKeyDown={(event) => {
        if (event.key === "Escape" && !event.defaultPrevented) onClose();
      }}
    >
      <header>
        <StatusSymbol name={lost ? "s-stale" : symbolOf(v)} size={22} />
        <h2>{v.name}</h2>
        <span className="grow" />
        <span className="cap nw age">
          {heard.heard_s === undefined ? t("what.never") : age(lost ? link.ageS : heard.heard_s)}
        </span>
        <Button quiet icon="x" label={t("card.close", { vehicle: v.name })} onPress={onClose} />
      </header>
      <div className="about" tabIndex={0} role="group" aria-label={t("card.about", { vehicle: v.name })}>
        {old && heard.heard_s !== undefined && (
          <p className="olddata" role="status">
            <StatusSymbol name="s-stale" /> {t("card.old", { time: timeOfDay(asOf) })}
          </p>
        )}
        {hand !== undefined && <p className="hands">{hand}</p>}
        <p className="does">{doing}</p>
        {why !== "" && (
          <p className="cause" data-alarm={alarm?.priority ?? "none"} role="status">
            {why}
          </p>
        )}
        {todo !== "" && <p className="lab">{todo}</p>}
        <WaitsFor vehicle={v} vehicles={vehicles} numberOf={numberOf} onSelect={onSelect} />
        <VehicleFacts vehicle={v} order={order} heard={heard} now={now} old={old} words={words} />
        <div className="links">
          <Link className="btn" to={`/vehicles/${to}`}>
            {t("card.open")}
          </Link>
          {v.load !== undefined && (
            <Link className="btn" to={`/loads/${encodeURIComponent(v.load)}`}>
              <Icon name="load" />
              {v.load_name}
            </Link>
          )}
          {may && (
            <Link className="btn" to={`/map?place=${to}`}>
              {t("place.link")}
            </Link>
          )}
        </div>
      </div>
      <div className="acts">
        <PauseVehicle vehicle={v} />
        <Link className="btn primary motion" to={`/send?vehicle=${to}`}>
          <Icon name="send" />
          <span>{t("card.send")}</span>
        </Link>
      </div>
    </section>
  );
}
