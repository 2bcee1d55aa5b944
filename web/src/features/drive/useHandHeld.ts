import { useEffect, useMemo, useSyncExternalStore } from "react";
import { openHandHeld } from "@/shared/api";
import { HandHeld, type HandState } from "./handHeld";
import { kHoldKey, kKeys, kShares } from "./twist";

/** The control of this page, connected as long as the page is open. Another window, tab or page lets go. */
export function useHandHeld(vehicle: string): { control: HandHeld; state: HandState } {
  const control = useMemo(() => new HandHeld(() => openHandHeld(vehicle), kShares[1]), [vehicle]);
  useEffect(() => {
    control.start();
    return () => control.stop();
  }, [control]);
  useEffect(() => {
    const letGo = () => control.release();
    const listens = [
      [window, "blur"],
      [window, "pagehide"],
      [document, "visibilitychange"],
    ] as const;
    for (const [target, type] of listens) target.addEventListener(type, letGo);
    return () => {
      for (const [target, type] of listens) target.removeEventListener(type, letGo);
    };
  }, [control]);
  useKeys(control);
  return { control, state: useSyncExternalStore(control.subscribe, () => control.state) };
}

/** Space holds, arrows or WASD drive, Q and E turn, 1 to 3 choose the speed: as long as this page has the vehicle. */
function useKeys(control: HandHeld): void {
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      const down = event.type === "keydown";
      const share = kShares[Number(/^Digit([123])$/.exec(event.code)?.[1]) - 1];
      const known = event.code === kHoldKey || Object.hasOwn(kKeys, event.code) || share !== undefined;
      if (!known || !control.state.mine || event.ctrlKey || event.altKey || event.metaKey) return;
      if (event.target instanceof HTMLInputElement) return;
      event.preventDefault(); // Space would press the button that has the focus
      if (event.repeat) return;
      if (event.code === kHoldKey) control.hold(down);
      else if (share !== undefined) control.setShare(share);
      else control.press(kKeys[event.code]!, down);
    };
    window.addEventListener("keydown", onKey);
    window.addEventListener("keyup", onKey);
    return () => {
      window.removeEventListener("keydown", onKey);
      window.removeEventListener("keyup", onKey);
    };
  }, [control]);
}
