import { useEffect, useRef, useState } from "react";
import { useTranslation } from "react-i18next";
import { Icon } from "./Icon";
import "./NumberPad.css";
import { isTyping, padKeyOf, pressKey, type PadKey } from "./padKeys";

const keys: readonly PadKey[] = ["1", "2", "3", "4", "5", "6", "7", "8", "9", "clear", "0", "delete"];

/** Number pad of twelve large keys; a keyboard's digits do the same wherever the focus is, but in a field that takes text. */
export function NumberPad({
  label,
  digits,
  onDigits,
}: {
  label: string;
  digits: string;
  onDigits: (digits: string) => void;
}) {
  const { t } = useTranslation();
  const [hit, setHit] = useState<PadKey>();
  const press = (key: PadKey) => {
    setHit(key);
    onDigits(pressKey(digits, key));
  };
  const pad = useRef<HTMLDivElement>(null);
  const latest = useRef(press);
  useEffect(() => {
    latest.current = press;
  });
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      const key = padKeyOf(event.key);
      if (key === undefined || event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented)
        return;
      // A pad in a folded step is not there for anybody.
      if (isTyping(event.target) || pad.current?.checkVisibility() !== true) return;
      event.preventDefault();
      latest.current(key);
    };
    document.addEventListener("keydown", onKey);
    return () => document.removeEventListener("keydown", onKey);
  }, []);
  return (
    <div className="pad" role="group" aria-label={label} ref={pad}>
      {keys.map((key) => (
        <button
          key={key}
          type="button"
          className={`key ${hit === key && digits !== "" ? "hit" : ""}`}
          aria-label={key === "clear" || key === "delete" ? t(`pad.${key}_label`) : undefined}
          onClick={() => press(key)}
        >
          {key === "clear" ? t("pad.clear") : key === "delete" ? <Icon name="del" /> : key}
        </button>
      ))}
    </div>
  );
}
