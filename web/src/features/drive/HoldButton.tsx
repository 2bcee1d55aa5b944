import type { ReactNode } from "react";

/** A button that counts only while a finger is on it, wherever the finger slides. Nothing is done by a click. */
export function HoldButton(props: {
  label: string;
  down: boolean;
  disabled: boolean;
  shortcuts: string;
  className?: string;
  children: ReactNode;
  onDown: (down: boolean) => void;
}) {
  const { label, down, disabled, shortcuts, className, children, onDown } = props;
  const up = () => onDown(false);
  return (
    <button
      type="button"
      className={`holdbtn ${className ?? ""}`}
      aria-label={label}
      aria-pressed={down}
      aria-disabled={disabled}
      aria-keyshortcuts={shortcuts}
      onPointerDown={(event) => {
        if (event.button !== 0 || disabled) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        onDown(true);
      }}
      onPointerUp={up}
      onPointerCancel={up}
      onLostPointerCapture={up}
      onContextMenu={(event) => event.preventDefault()}
    >
      {children}
    </button>
  );
}
