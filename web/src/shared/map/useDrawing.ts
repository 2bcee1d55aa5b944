import { useEffect, useRef, type RefObject } from "react";
import { useTheme } from "@/shared/i18n/useTheme";
import { liveStore } from "@/shared/live/store";
import { readPalette, type Palette } from "./palette";
import { CanvasRenderer, type FrameInput } from "./renderer";
import type { DrawnVehicle } from "./scene";

const kAgeTickMs = 250;

export interface Drawing {
  /** Draws in the next animation frame, once however often it is asked. */
  request: () => void;
  /** Vehicles as last drawn, for picking. */
  drawn: () => readonly DrawnVehicle[];
}

/** Draws the map whenever the store or the page has something new. Poses reach the canvas without React. */
export function useDrawing(
  canvas: RefObject<HTMLCanvasElement | null>,
  compose: () => Omit<FrameInput, "palette" | "live" | "dpr" | "nowMs"> | undefined,
): Drawing {
  const theme = useTheme();
  const renderer = useRef<CanvasRenderer>(undefined);
  const palette = useRef<Palette>(undefined);
  const frame = useRef(0);
  const draw = useRef(() => {});
  draw.current = () => {
    frame.current = 0;
    const what = compose();
    if (canvas.current === null || what === undefined) return;
    renderer.current ??= new CanvasRenderer(canvas.current);
    palette.current ??= readPalette(canvas.current);
    const { state, poses } = liveStore;
    renderer.current.draw({
      ...what,
      palette: palette.current,
      dpr: window.devicePixelRatio || 1,
      live: {
        vehicles: state.vehicles,
        stations: state.stations,
        poses,
        closures: state.closures,
        linkLost: state.link.kind === "lost",
      },
      nowMs: performance.now(),
    });
  };
  const drawing = useRef<Drawing>({
    request: () => {
      if (frame.current === 0) frame.current = requestAnimationFrame(() => draw.current());
    },
    drawn: () => renderer.current?.drawn ?? [],
  });

  useEffect(() => {
    const ask = drawing.current.request;
    const stop = [liveStore.subscribe(ask), liveStore.subscribePoses(ask)];
    // Ages and labels go on while nothing moves.
    const timer = setInterval(ask, kAgeTickMs);
    return () => {
      clearInterval(timer);
      stop.forEach((end) => end());
      cancelAnimationFrame(frame.current);
      frame.current = 0;
    };
  }, []);
  useEffect(() => {
    palette.current = undefined;
    drawing.current.request();
  }, [theme]);
  // The page has drawn itself anew: something the map shows may be another.
  useEffect(() => drawing.current.request());
  return drawing.current;
}
