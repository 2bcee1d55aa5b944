import { boxOf, type Box } from "@/shared/math/geometry";
import type { Pen } from "./pen";
import type { HallModel } from "./scene";

export interface Caption {
  text: string;
  /** The zone's box in metres; the caption stands in its upper left corner. */
  area: Box;
  width: number;
  height: number;
}

/** Capitals, but for a word that has its own: iGPS is a name. */
export const inCapitals = (name: string): string =>
  name.replace(/\S+/g, (word) => (/.[A-Z]/.test(word) ? word : word.toLocaleUpperCase()));

/** Names of zones that are wide enough for them. They are floor: drawn with the hall, below all that moves. */
export function captionsOf(pen: Pen, model: HallModel): Caption[] {
  pen.g.font = `700 13px ${pen.palette.font}`;
  return model.areas.flatMap((area) => {
    if (area.kind !== "zone" || area.name === "") return [];
    const box = boxOf(area.outline);
    const text = inCapitals(area.name);
    const width = pen.g.measureText(text).width + 12;
    return width > (box.maxX - box.minX) * pen.k - 8 ? [] : [{ text, area: box, width, height: 18 }];
  });
}

export function drawCaptions(pen: Pen, model: HallModel): void {
  const { g, palette } = pen;
  for (const { text, area, width, height } of captionsOf(pen, model)) {
    const corner = pen.at(area.minX, area.maxY);
    g.fillStyle = palette["map-zone"];
    g.fillRect(corner.x + 6, corner.y + 1, width, height);
    g.textAlign = "left";
    g.textBaseline = "middle";
    g.fillStyle = palette["ink-3"];
    g.fillText(text, corner.x + 12, corner.y + 11);
  }
}
