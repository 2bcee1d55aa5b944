import { useTranslation } from "react-i18next";
import type { Scale } from "./closeUp";
import "./ScaleChoice.css";

/** How close a picture looks: at the stops themselves, or at all of their tolerance. */
export function ScaleChoice(props: {
  scale: Scale;
  onScale: (scale: Scale) => void;
  /** Half the width of either picture, with its unit; undefined where its rows differ. */
  close?: string;
  tolerance?: string;
}) {
  const { t } = useTranslation("records");
  return (
    <span className="seg scalechoice" role="group" aria-label={t("scale.label")}>
      {(["close", "tolerance"] as const).map((one) => (
        <button key={one} type="button" aria-pressed={props.scale === one} onClick={() => props.onScale(one)}>
          {[t(`scale.${one}`), props[one]].filter(Boolean).join(" ")}
        </button>
      ))}
    </span>
  );
}
