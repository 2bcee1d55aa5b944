import { useState } from "react";
import { useTranslation } from "react-i18next";
import { Icon } from "./Icon";
import "./NumberPad.css";
import { padKeyOf, pressKey, type PadKey } from "./padKeys";

const keys: readonly PadKey[] = ["1", "2", "3", "4", "5", "6", "7", "8", "9", "clear", "0", "delete"];

/** Number pad of twelve large keys; the keyboard's digits do the same while it has the focus. */
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
  return (
    <div
      className="pad"
      role="group"
      aria-label={label}
      onKeyDown={(event) => {
        const key = padKeyOf(event.key);
        if (key === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        press(key);
      }}
    >
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
