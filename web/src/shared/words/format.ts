/** Numbers as a person reads them: real minus sign, explicit plus on deviations, fixed decimals. */

const kDash = "\u2013";
const kMinus = "\u2212";
const kThin = "\u00a0";

export interface NumberStyle {
  decimals?: number;
  sign?: boolean; // explicit plus
}

/** `undefined` and non-finite values are values never received: an en dash. */
export function number(value: number | undefined, style: NumberStyle = {}): string {
  if (value === undefined || !Number.isFinite(value)) return kDash;
  const decimals = style.decimals ?? 0;
  const text = Math.abs(value).toLocaleString("en-US", {
    minimumFractionDigits: decimals,
    maximumFractionDigits: decimals,
  });
  const isZero = /^[0.,]*$/.test(text);
  if (isZero) return text;
  return value < 0 ? kMinus + text : style.sign ? `+${text}` : text;
}

export function millimetres(value_m: number | undefined, style: NumberStyle = {}): string {
  return number(value_m === undefined ? undefined : value_m * 1000, style);
}

export function degrees(value_rad: number | undefined, style: NumberStyle = {}): string {
  return number(value_rad === undefined ? undefined : (value_rad * 180) / Math.PI, { decimals: 3, ...style });
}

/** Heading in (-180, 180]. */
export function heading(value_rad: number | undefined, style: NumberStyle = {}): string {
  return degrees(value_rad === undefined ? undefined : wrap(value_rad), style);
}

export function wrap(angle_rad: number): number {
  const turn = 2 * Math.PI;
  const wrapped = angle_rad - turn * Math.round(angle_rad / turn);
  return wrapped <= -Math.PI ? wrapped + turn : wrapped;
}

/** A length in the unit that suits it: mm below 1 m, km from 1000 m. */
export function length(value_m: number | undefined): string {
  if (value_m === undefined || !Number.isFinite(value_m)) return kDash;
  const size = Math.abs(value_m);
  if (size < 1) return `${number(value_m * 1000, { decimals: size < 0.01 ? 1 : 0 })}${kThin}mm`;
  if (size < 1000) return `${number(value_m, { decimals: size < 100 ? 2 : 0 })}${kThin}m`;
  return `${number(value_m / 1000, { decimals: 1 })}${kThin}km`;
}

export function tonnes(value_kg: number | undefined): string {
  if (value_kg === undefined || !Number.isFinite(value_kg)) return kDash;
  return Math.abs(value_kg) < 100
    ? `${number(value_kg, { decimals: 0 })}${kThin}kg`
    : `${number(value_kg / 1000, { decimals: 1 })}${kThin}t`;
}

export function kilonewtons(value_n: number | undefined, decimals = 1): string {
  return number(value_n === undefined ? undefined : value_n / 1000, { decimals });
}

/** 1:31, or 1:02:05 from an hour on. */
export function duration(value_s: number | undefined): string {
  if (value_s === undefined || !Number.isFinite(value_s)) return kDash;
  const all = Math.max(0, Math.round(value_s));
  const pad = (n: number) => String(n).padStart(2, "0");
  const h = Math.floor(all / 3600);
  const m = Math.floor((all % 3600) / 60);
  return h > 0 ? `${h}:${pad(m)}:${pad(all % 60)}` : `${m}:${pad(all % 60)}`;
}

/** Age of a value: tenths below 10 s, then whole seconds, then minutes. */
export function age(value_s: number | undefined): string {
  if (value_s === undefined || !Number.isFinite(value_s)) return kDash;
  const s = Math.max(0, value_s);
  if (s < 9.95) return `${s.toFixed(1)}${kThin}s`;
  if (s < 60) return `${Math.floor(s)}${kThin}s`;
  return duration(s);
}

/** Time of day, 24 h, as the clock of the shell shows it. */
export function timeOfDay(at: string | Date | number | undefined): string {
  if (at === undefined) return kDash;
  const date = at instanceof Date ? at : new Date(at);
  if (Number.isNaN(date.getTime())) return kDash;
  const pad = (n: number) => String(n).padStart(2, "0");
  return `${pad(date.getHours())}:${pad(date.getMinutes())}:${pad(date.getSeconds())}`;
}

/** Date before the time when it is not today. */
export function dateTime(at: string | undefined, now: Date = new Date()): string {
  if (at === undefined) return kDash;
  const date = new Date(at);
  if (Number.isNaN(date.getTime())) return kDash;
  const sameDay = date.toDateString() === now.toDateString();
  const pad = (n: number) => String(n).padStart(2, "0");
  const day = `${date.getFullYear()}-${pad(date.getMonth() + 1)}-${pad(date.getDate())}`;
  return sameDay ? timeOfDay(date) : `${day} ${timeOfDay(date)}`;
}

/** Seconds since `at`, never negative: clocks of two machines differ a little. */
export function secondsSince(at: string | undefined, now_ms: number): number | undefined {
  if (at === undefined) return undefined;
  const then = Date.parse(at);
  return Number.isNaN(then) ? undefined : Math.max(0, (now_ms - then) / 1000);
}
