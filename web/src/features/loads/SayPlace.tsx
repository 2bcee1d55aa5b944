import { useState } from "react";
import { useTranslation } from "react-i18next";
import { usePlaceLoad } from "@/shared/body/usePlaceLoad";
import { CommandFailed, useRefusal } from "@/shared/commands";
import { useStations, useVehicles } from "@/shared/live";
import { Button, CommandButton } from "@/shared/ui";
import { useWords } from "@/shared/words/useWords";
import { placesFor, same, type Place } from "./places";
import type { LiveLoad } from "./useLiveLoads";

/** A person says where it is, for when nobody saw it come or go. Nothing moves by it. */
export function SayPlace({ load }: { load: LiveLoad }) {
  const { t } = useTranslation("loads");
  const [open, setOpen] = useState(false);
  if (!open) {
    return (
      <Button className="lsay" onPress={() => setOpen(true)}>
        {t("say.open")}
      </Button>
    );
  }
  return <Form load={load} />;
}

function Form({ load }: { load: LiveLoad }) {
  const { t } = useTranslation(["loads", "common"]);
  const words = useWords();
  const refused = useRefusal();
  const free = placesFor(load, load.place, useVehicles(), useStations());
  const places: Place[] = [
    ...free.vehicles.map((vehicle) => ({ vehicle })),
    ...free.stations.map((station) => ({ station })),
    ...(free.nowhere ? [{}] : []),
  ];
  const [chosen, setChosen] = useState<Place>();
  const arrived = chosen !== undefined && same(chosen, load.place);
  const { command, progress } = usePlaceLoad(load.id, chosen, arrived, t("common:brand"));
  const nameOf = ({ vehicle, station }: Place) =>
    vehicle !== undefined
      ? t("say.on", { vehicle: words.vehicle(vehicle) })
      : station !== undefined
        ? t("say.at", { number: station })
        : t("say.nowhere");
  // It stays chosen until it is confirmed, although it is where the load now is.
  const offered = arrived ? [...places, chosen] : places;
  if (offered.length === 0) return <p className="lab">{t("say.none")}</p>;
  return (
    <div className="lform">
      <span className="cap">{t("say.which")}</span>
      <div className="lplaces" role="group" aria-label={t("say.which")}>
        {offered.map((place) => (
          <button
            key={nameOf(place)}
            type="button"
            className="btn"
            aria-pressed={chosen !== undefined && same(place, chosen)}
            onClick={() => setChosen(place)}
          >
            {nameOf(place)}
          </button>
        ))}
      </div>
      <CommandButton
        label={t("say.run", { load: load.name })}
        primary={false}
        direction="go"
        progress={progress}
        disabledReason={refused ?? (chosen === undefined ? t("say.choose") : undefined)}
        onRun={command.run}
      />
      <CommandFailed command={command} />
    </div>
  );
}
