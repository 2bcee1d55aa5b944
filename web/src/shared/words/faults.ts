/** Key of a fault's words: "wheelFault" and "wheel_fault" are one. */
export const faultKey = (type: string) => type.replace(/([a-z0-9])([A-Z])/g, "$1_$2").toLowerCase();

/** A fault in words; one that nobody has put into words is named as the vehicle names it. */
export function faultText(
  type: string,
  t: (key: string, values?: Record<string, unknown>) => string,
): string {
  const plain = faultKey(type).replaceAll("_", " ");
  return t(`faults:${faultKey(type)}`, { defaultValue: t("faults:other", { type: plain }) });
}
