import { useTranslation } from "react-i18next";
import type { ReactNode } from "react";
import type { Plant } from "@/shared/api/types";
import "./Legend.css";

/** Key to the drawing, and the map's buttons at its end. */
export function Legend({ plant, children }: { plant: Plant; children: ReactNode }) {
  const { t } = useTranslation("map");
  return (
    <div className="legend" role="group" aria-label={t("legend.label")}>
      <span>
        <svg viewBox="0 0 36 16" aria-hidden="true">
          <path d="M0 8H26" stroke="var(--grant)" strokeWidth="4" />
          <path d="M26 2.5L36 8L26 13.5Z" fill="var(--grant)" />
        </svg>
        {t("legend.granted")}
      </span>
      <span>
        <svg viewBox="0 0 36 16" aria-hidden="true">
          <path d="M0 8H36" stroke="var(--horizon)" strokeWidth="2" strokeDasharray="6 5" />
        </svg>
        {t("legend.horizon")}
      </span>
      <span className="gt-sm">
        <svg viewBox="0 0 36 16" aria-hidden="true">
          <path d="M0 8H36" stroke="var(--map-route)" strokeWidth="1.5" strokeDasharray="14 3 3 3" />
        </svg>
        {t("legend.roadmap")}
      </span>
      <span className="gt-sm">
        <svg viewBox="0 0 36 16" aria-hidden="true">
          <rect x="3" y="3" width="10" height="10" fill="var(--map-marker)" />
          <circle cx="27" cy="8" r="5" fill="none" stroke="var(--map-marker)" strokeWidth="1.5" />
        </svg>
        {t("legend.marker")}
      </span>
      {(plant.transmitters ?? []).length > 0 && (
        <span className="gt-sm">
          <svg viewBox="0 0 16 16" className="one" aria-hidden="true">
            <path d="M8 2L13.2 11H2.8Z" fill="none" stroke="var(--map-marker)" strokeWidth="1.25" />
            <circle cx="8" cy="8" r="1.25" fill="var(--map-marker)" />
          </svg>
          {t("legend.transmitter")}
        </span>
      )}
      {(plant.reflectors ?? []).length > 0 && (
        <span className="gt-sm">
          <svg viewBox="0 0 16 16" className="one" aria-hidden="true">
            <circle cx="8" cy="8" r="4.5" fill="none" stroke="var(--map-marker)" strokeWidth="1" />
            <circle cx="8" cy="8" r="1.75" fill="var(--map-marker)" />
          </svg>
          {t("legend.reflector")}
        </span>
      )}
      <span>
        <svg viewBox="0 0 36 16" aria-hidden="true">
          <rect
            x="2"
            y="2"
            width="32"
            height="12"
            fill="none"
            stroke="var(--ink-2)"
            strokeWidth="1.75"
            strokeDasharray="4 3"
          />
        </svg>
        {t("legend.stale")}
      </span>
      <span className="r" />
      <span className="gt-sm cap">{t("legend.revision", { revision: plant.revision })}</span>
      {children}
    </div>
  );
}
