import { number } from "@/shared/words/format";
import { limitDecimals } from "./trendScale";

/** A limit with no more decimals than it needs: 25, 12.5, 0.2. */
export function limitText(limit: number): string {
  return number(limit, { decimals: limitDecimals(limit) });
}
