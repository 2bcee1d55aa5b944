import { duration, fixed, kNone, kThin, mass, timeOfDay } from "@/shared/i18n/format";

export { age, duration, fixed, kMinus, kNone, kThin, mass, timeOfDay } from "@/shared/i18n/format";

const finite = (value: number | undefined): value is number => value !== undefined && Number.isFinite(value);
const two = (n: number) => String(n).padStart(2, "0");

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

/** One parameter of a check, the unit read from its name. Places and vehicles are named before. */
export function parameter(name: string, value: number): string {
  if (name.endsWith("_m2")) return `${number(value)}${kThin}m²`;
  if (name.endsWith("_mps")) return `${fixed(value, 2)}${kThin}m/s`;
  if (name.endsWith("_m")) return length(value);
  if (name.endsWith("_rad")) return `${degrees(value, { decimals: 2 })}°`;
  if (name.endsWith("_s")) return value < 60 ? `${fixed(value, 1)}${kThin}s` : duration(value);
  if (name.endsWith("_n")) return `${kilonewtons(value)}${kThin}kN`;
  if (name.endsWith("_kg")) return mass(value);
  if (name.endsWith("_c")) return `${fixed(value, 0)}${kThin}°C`;
  if (name.endsWith("_percent")) return `${fixed(value, value < 10 ? 1 : 0)}${kThin}%`;
  return number(value, { decimals: Number.isInteger(value) ? 0 : 1 });
}
