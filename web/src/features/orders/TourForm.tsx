import { useState } from "react";
import { useTranslation } from "react-i18next";
import type { DryRun, Plant } from "@/shared/api/types";
import { MapView } from "@/shared/map";
import { Button, Card, NumberPad } from "@/shared/ui";
import { TourFields } from "./TourFields";
import { TourFoot } from "./TourFoot";
import { TourRow } from "./TourRow";
import { useTour } from "./useTour";
import "./TourForm.css";

/** A new job order with one or more stations. */
export function TourForm({ plant, onClose }: { plant: Plant | undefined; onClose: () => void }) {
  const { t } = useTranslation("orders");
  const tour = useTour(plant);
  const { state, dispatch, data } = tour;
  const [activeId, setActive] = useState(1);
  const active = state.steps.find((s) => s.id === activeId) ?? state.steps[0]!;
  return (
    <Card
      className="odetail tour"
      title={t("tour.title")}
      right={
        <Button quiet onPress={onClose}>
          {t("tour.cancel")}
        </Button>
      }
    >
      <TourFields state={state} dispatch={dispatch} />
      <h3 className="cap">{t("tour.stations")}</h3>
      <div className="tourwork">
        <ol className="tourlist">
          {state.steps.map((step, i) => (
            <TourRow
              key={step.id}
              step={step}
              index={i + 1}
              last={i === state.steps.length - 1}
              only={state.steps.length === 1}
              active={step.id === active.id}
              place={plant?.stations.find((s) => String(s.number) === step.station)?.name ?? ""}
              fault={tour.wrong.find((f) => f.id === step.id)}
              preview={data?.steps[i]}
              arrival={tour.arrivals[i]}
              onActive={() => setActive(step.id)}
              dispatch={dispatch}
            />
          ))}
          <li className="more">
            <Button
              icon="plus"
              onPress={() => {
                setActive(state.nextId);
                dispatch({ kind: "add" });
              }}
            >
              {t("tour.add")}
            </Button>
          </li>
        </ol>
        <NumberPad
          label={t("tour.pad")}
          digits={active.station}
          onDigits={(station) => dispatch({ kind: "station", id: active.id, station })}
        />
      </div>
      {plant && data && <TourMap plant={plant} areas={tour.areas} vehicle={data.vehicle} />}
      <TourFoot tour={tour} />
    </Card>
  );
}

type TourMapProps = Pick<ReturnType<typeof useTour>, "areas"> & { plant: Plant; vehicle: DryRun["vehicle"] };

/** The floor that the drives of the tour would take. */
function TourMap({ plant, areas, vehicle }: TourMapProps) {
  const { t } = useTranslation("orders");
  const about = areas.flatMap((area) => area.rings.flat());
  return (
    <div className="tourmap">
      <MapView
        plant={plant}
        overlays={{ areas }}
        {...(about.length > 0 && { about })}
        selected={vehicle || undefined}
        label={t("tour.map")}
      />
    </div>
  );
}
