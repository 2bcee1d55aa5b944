import type { Vehicle } from "@/shared/api/types";

/** How far one bracket may be off the mean of all; beyond it the server starts no move. */
export const kBracketBalance = 0.1;
/** Below this there is no load, only noise. */
const kLoad_n = 1000;

/** The bracket that is farthest off the mean of all, when that is too far; `share` of the mean, signed. */
export function bracketFault(
  brackets: readonly Vehicle["brackets"][number][],
): { bracket: string; share: number } | undefined {
  const sums = brackets.map((b) => ({ bracket: b.name, force: b.force_a_n + b.force_b_n }));
  const total = sums.reduce((sum, b) => sum + b.force, 0);
  if (total < kLoad_n) return undefined;
  const mean = total / sums.length;
  const [worst] = sums
    .map((b) => ({ bracket: b.bracket, share: b.force / mean - 1 }))
    .sort((a, b) => Math.abs(b.share) - Math.abs(a.share));
  return worst !== undefined && Math.abs(worst.share) > kBracketBalance ? worst : undefined;
}
