/** Keys of the number pad. */
export type PadKey = "0" | "1" | "2" | "3" | "4" | "5" | "6" | "7" | "8" | "9" | "clear" | "delete";

const kMaxDigits = 4;

export function pressKey(digits: string, key: PadKey): string {
  if (key === "clear") return "";
  if (key === "delete") return digits.slice(0, -1);
  const next = digits === "0" ? key : digits + key;
  return next.length > kMaxDigits ? digits : next;
}

export function padKeyOf(keyboardKey: string): PadKey | undefined {
  if (/^[0-9]$/.test(keyboardKey)) return keyboardKey as PadKey;
  if (keyboardKey === "Backspace") return "delete";
  if (keyboardKey === "Delete") return "clear";
  return undefined;
}

/** Whether a key that goes there is text of somebody's. */
export function isTyping(target: unknown): boolean {
  const at = target as { tagName?: string; isContentEditable?: boolean } | null;
  return at?.isContentEditable === true || /^(INPUT|TEXTAREA|SELECT)$/.test(at?.tagName ?? "");
}
