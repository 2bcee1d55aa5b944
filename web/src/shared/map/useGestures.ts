import { useEffect, type RefObject } from "react";
import type { ScreenPoint } from "./view";

export interface Gestures {
  pan: (dx: number, dy: number) => void;
  zoom: (at: ScreenPoint, factor: number) => void;
  press: (at: ScreenPoint) => void;
  hover: (at: ScreenPoint) => void;
}

const kSlackPx = 6;

/** Drag and touch pan, wheel and pinch zoom; what did not move is a press. */
export function useGestures(
  canvas: RefObject<HTMLCanvasElement | null>,
  gestures: RefObject<Gestures>,
): void {
  useEffect(() => {
    const element = canvas.current;
    if (element === null) return;
    const pointers = new Map<number, ScreenPoint>();
    let start: ScreenPoint | undefined;
    let moved = false;

    const at = (event: PointerEvent | WheelEvent): ScreenPoint => {
      const box = element.getBoundingClientRect();
      return { x: event.clientX - box.left, y: event.clientY - box.top };
    };
    const down = (event: PointerEvent) => {
      if (event.button !== 0) return;
      element.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, at(event));
      if (pointers.size === 1) {
        start = at(event);
        moved = false;
      } else {
        moved = true;
      }
    };
    const move = (event: PointerEvent) => {
      const old = pointers.get(event.pointerId);
      const now = at(event);
      if (old === undefined) {
        gestures.current.hover(now);
        return;
      }
      if (!moved && start && Math.hypot(now.x - start.x, now.y - start.y) < kSlackPx) return;
      moved = true;
      const others = [...pointers].filter(([id]) => id !== event.pointerId).map(([, p]) => p);
      const other = others[0];
      if (other === undefined) {
        gestures.current.pan(now.x - old.x, now.y - old.y);
      } else {
        const before = Math.hypot(old.x - other.x, old.y - other.y);
        const after = Math.hypot(now.x - other.x, now.y - other.y);
        gestures.current.pan((now.x - old.x) / 2, (now.y - old.y) / 2);
        if (before > 1 && after > 1) {
          gestures.current.zoom({ x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 }, after / before);
        }
      }
      pointers.set(event.pointerId, now);
    };
    const up = (event: PointerEvent) => {
      const was = pointers.delete(event.pointerId);
      if (was && pointers.size === 0 && !moved && event.type === "pointerup")
        gestures.current.press(at(event));
    };
    const wheel = (event: WheelEvent) => {
      event.preventDefault();
      const pixels = event.deltaMode === 1 ? event.deltaY * 16 : event.deltaY;
      gestures.current.zoom(at(event), Math.exp(-Math.max(-200, Math.min(200, pixels)) * 0.0018));
    };
    element.addEventListener("pointerdown", down);
    element.addEventListener("pointermove", move);
    element.addEventListener("pointerup", up);
    element.addEventListener("pointercancel", up);
    element.addEventListener("wheel", wheel, { passive: false });
    return () => {
      element.removeEventListener("pointerdown", down);
      element.removeEventListener("pointermove", move);
      element.removeEventListener("pointerup", up);
      element.removeEventListener("pointercancel", up);
      element.removeEventListener("wheel", wheel);
    };
  }, [canvas, gestures]);
}
