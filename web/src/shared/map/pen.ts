import { placed, type MetricPoint, type PoseLike } from "@/shared/math/geometry";
import type { Palette } from "./palette";
import { toScreen, type Size, type View } from "./view";

const tiles = new Map<string, HTMLCanvasElement>();

function dotTile(colour: string, step: number, radius: number): HTMLCanvasElement | undefined {
  const key = `${colour}/${step}/${radius}`;
  const known = tiles.get(key);
  if (known !== undefined) return known;
  const tile = document.createElement("canvas");
  tile.width = step;
  tile.height = step;
  const g = tile.getContext("2d");
  if (g === null) return undefined;
  g.fillStyle = colour;
  g.arc(step / 2, step / 2, radius, 0, 7);
  g.fill();
  tiles.set(key, tile);
  return tile;
}

/** Draws geometry of the hall in screen pixels: shapes scale, ink does not. */
export class Pen {
  constructor(
    readonly g: CanvasRenderingContext2D,
    readonly view: View,
    readonly size: Size,
    readonly palette: Palette,
  ) {}

  get k(): number {
    return this.view.pxPerM;
  }

  at(x_m: number, y_m: number) {
    return toScreen(this.view, this.size, { x_m, y_m });
  }

  path(points: readonly MetricPoint[], closed: boolean, begin = true): void {
    if (begin) this.g.beginPath();
    points.forEach((p, i) => {
      const s = this.at(p.x_m, p.y_m);
      if (i === 0) this.g.moveTo(s.x, s.y);
      else this.g.lineTo(s.x, s.y);
    });
    if (closed) this.g.closePath();
  }

  body(points: readonly MetricPoint[], pose: PoseLike): void {
    this.path(placed(points, pose), true);
  }

  stroke(colour: string, width: number, dash: readonly number[] = [], alpha = 1): void {
    const { g } = this;
    g.strokeStyle = colour;
    g.lineWidth = width;
    g.setLineDash([...dash]);
    g.globalAlpha = alpha;
    g.stroke();
    g.globalAlpha = 1;
    g.setLineDash([]);
  }

  fill(colour: string, alpha = 1): void {
    this.g.globalAlpha = alpha;
    this.g.fillStyle = colour;
    this.g.fill();
    this.g.globalAlpha = 1;
  }

  /** Dots in screen pixels inside the current path. */
  dots(colour: string, step: number, radius: number): void {
    const tile = dotTile(colour, step, radius);
    const pattern = tile && this.g.createPattern(tile, "repeat");
    if (!pattern) return;
    this.g.fillStyle = pattern;
    this.g.fill();
  }

  /** 45 degree hatch in screen pixels inside the current path. */
  hatch(colour: string, step: number, width: number): void {
    const { g, size } = this;
    g.save();
    g.clip();
    g.beginPath();
    for (let x = -size.height; x < size.width; x += step) {
      g.moveTo(x, size.height);
      g.lineTo(x + size.height, 0);
    }
    this.stroke(colour, width);
    g.restore();
  }
}
