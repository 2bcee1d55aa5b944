// Numbers as people on the floor read them: millimetres, degrees, real minus, tabular.
export const kMinus = "\u2212";
export const kThin = "\u00a0"; // no-break, so that a unit never stands alone on a line
export const kNone = "\u2013"; // never received

const finite = (value: number | undefined): value is number => value !== undefined && Number.isFinite(value);
const two = (n: number) => String(n).padStart(2, "0");

/** Fixed decimals, real minus sign, never "-0.0". */
export function fixed(value: number | undefined, decimals: number): string {
  if (!finite(value)) return kNone;
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? kMinus + text : text;
}

/** As `fixed`, with an explicit plus: for deviations. */
export function signed(value: number | undefined, decimals: number): string {
  if (!finite(value)) return kNone;
  const text = fixed(value, decimals);
  return Number(Math.abs(value).toFixed(decimals)) === 0 || value < 0 ? text : `+${text}`;
}

const inMm = (m: number | undefined) => (finite(m) ? m * 1000 : undefined);
const inDeg = (rad: number | undefined) => (finite(rad) ? (rad * 180) / Math.PI : undefined);
export const mmValue = (m: number | undefined, decimals = 0) => fixed(inMm(m), decimals);
export const signedMm = (m: number | undefined, decimals = 1) => signed(inMm(m), decimals);
export const degValue = (rad: number | undefined, decimals = 1) => fixed(inDeg(rad), decimals);
export const signedDeg = (rad: number | undefined, decimals = 2) => signed(inDeg(rad), decimals);

/** "25 mm" */
export const mm = (m: number | undefined, decimals = 0) => `${mmValue(m, decimals)}${kThin}mm`;
/** "0.20°", degree sign tight. */
export const deg = (rad: number | undefined, decimals = 1) => `${degValue(rad, decimals)}°`;
/** "22.0 m" */
export const metres = (m: number | undefined, decimals = 1) => `${fixed(m, decimals)}${kThin}m`;
/** Short spans with tenths: "0.2 s". */
export const seconds = (s: number | undefined) => `${fixed(s, 1)}${kThin}s`;

/** Duration as m:ss, from an hour on h:mm:ss. */
export function duration(s: number | undefined): string {
  if (!finite(s)) return kNone;
  const total = Math.max(0, Math.round(s));
  const hours = Math.floor(total / 3600);
  const minutes = Math.floor((total % 3600) / 60);
  return hours > 0 ? `${hours}:${two(minutes)}:${two(total % 60)}` : `${minutes}:${two(total % 60)}`;
}

/** A duration that may be years: whole days from two of them on. */
export function days(s: number | undefined): string {
  const kDay_s = 86_400;
  return finite(s) && s >= 2 * kDay_s ? `${Math.round(s / kDay_s)}${kThin}d` : duration(s);
}

/** Age of a value: tenths below ten seconds, whole seconds below a minute, then m:ss. */
export function age(s: number | undefined): string {
  if (!finite(s)) return kNone;
  const value = Math.max(0, s);
  if (value < 9.95) return seconds(value);
  if (value < 59.5) return `${Math.round(value)}${kThin}s`;
  return duration(value);
}

/** Wall-clock time hh:mm:ss of this panel. */
export function timeOfDay(when: string | number | Date | undefined): string {
  if (when === undefined) return kNone;
  const date = when instanceof Date ? when : new Date(when);
  if (Number.isNaN(date.getTime())) return kNone;
  return `${two(date.getHours())}:${two(date.getMinutes())}:${two(date.getSeconds())}`;
}

/** Mass: kilograms below a tonne, else tonnes. */
export function mass(kg: number | undefined): string {
  if (!finite(kg)) return kNone;
  return kg >= 1000 ? `${fixed(kg / 1000, 1)}${kThin}t` : `${fixed(kg, 0)}${kThin}kg`;
}
