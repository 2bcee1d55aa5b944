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

/** Short spans with tenths: "0.2 s". */
const seconds = (s: number | undefined) => `${fixed(s, 1)}${kThin}s`;

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

export interface NumberStyle {
  decimals?: number;
  /** Explicit plus, for deviations. */
  sign?: boolean;
}

/** Fixed decimals with groups of three, as the drawings have them: "84,997.24". */
export function number(value: number | undefined, { decimals = 0, sign = false }: NumberStyle = {}): string {
  if (!finite(value)) return kNone;
  const text = fixed(value, decimals).replace(/\d+/, (whole) => whole.replace(/\B(?=(\d{3})+$)/g, ","));
  const isZero = !/[1-9]/.test(text);
  return sign && value > 0 && !isZero ? `+${text}` : text;
}

export function millimetres(value_m: number | undefined, style: NumberStyle = {}): string {
  return number(finite(value_m) ? value_m * 1000 : undefined, style);
}

export function degrees(value_rad: number | undefined, style: NumberStyle = {}): string {
  return number(finite(value_rad) ? (value_rad * 180) / Math.PI : undefined, { decimals: 3, ...style });
}

/** Heading in (-180, 180]. */
export function heading(value_rad: number | undefined, style: NumberStyle = {}): string {
  return degrees(finite(value_rad) ? wrap(value_rad) : undefined, style);
}

export function wrap(angle_rad: number): number {
  const turn = 2 * Math.PI;
  const wrapped = angle_rad - turn * Math.round(angle_rad / turn);
  return wrapped <= -Math.PI ? wrapped + turn : wrapped;
}

/** A length in the unit that suits it: mm below 0.1 m, km from 1000 m. */
export function length(value_m: number | undefined): string {
  if (!finite(value_m)) return kNone;
  const size = Math.abs(value_m);
  if (size < 0.1) return `${number(value_m * 1000, { decimals: size < 0.01 ? 1 : 0 })}${kThin}mm`;
  if (size < 1000) return `${number(value_m, { decimals: size < 100 ? 2 : 0 })}${kThin}m`;
  return `${number(value_m / 1000, { decimals: 1 })}${kThin}km`;
}

export function kilonewtons(value_n: number | undefined, decimals = 1): string {
  return number(finite(value_n) ? value_n / 1000 : undefined, { decimals });
}

/** Time of day; with the date before it when it is not of the same day as `now_ms`. */
export function dateTime(at: string | undefined, now_ms: number): string {
  const date = new Date(at ?? NaN);
  if (Number.isNaN(date.getTime())) return kNone;
  if (date.toDateString() === new Date(now_ms).toDateString()) return timeOfDay(date);
  return `${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())} ${timeOfDay(date)}`;
}

/** Seconds since `at`, never negative: clocks of two machines differ a little. */
export function secondsSince(at: string | undefined, now_ms: number): number | undefined {
  if (at === undefined) return undefined;
  const then = Date.parse(at);
  return Number.isNaN(then) ? undefined : Math.max(0, (now_ms - then) / 1000);
}

/** One parameter as a person reads it: its unit is in its name. */
export function parameter(name: string, value: number): string {
  if (name.endsWith("_m2")) return `${number(value, { decimals: value < 100 ? 1 : 0 })}${kThin}m²`;
  if (name.endsWith("_mps")) return `${fixed(value, 2)}${kThin}m/s`;
  if (name === "along_m") return length(Math.abs(value)); // ahead or behind: the wording says which
  if (name.endsWith("_m")) return length(value);
  if (name.endsWith("_rad")) return `${degrees(value, { decimals: 2 })}°`;
  if (name.endsWith("_s")) return age(value);
  if (name.endsWith("_n")) return `${kilonewtons(value)}${kThin}kN`;
  if (name.endsWith("_kg")) return mass(value);
  if (name.endsWith("_c")) return `${fixed(value, 0)}${kThin}°C`;
  if (name.endsWith("_percent"))
    return `${fixed(value, value < 10 && !Number.isInteger(value) ? 1 : 0)}${kThin}%`;
  return Number.isInteger(value) ? String(value) : fixed(value, 2); // numbers of stations have no groups of three
}
