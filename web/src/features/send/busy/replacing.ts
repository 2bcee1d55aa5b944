import type { ApiProblem } from "@/shared/api";
import type { JobOrder } from "@/shared/api/types";
import type { Refusal } from "../start/startCommand";

/** The order that a new one takes the place of, as it was named to the person who confirmed. */
export type Replaced = Pick<JobOrder, "id" | "name" | "created_by">;

/**
 * The second half of Replace. The new order is stored first and waits behind the other, so that whatever
 * becomes of the cancelling, no order is lost: at worst it is a "Send after".
 */
export type Replacing =
  | { kind: "none" }
  | { kind: "cancelling"; order: Replaced }
  /** Stored by the server: the other order ends when its vehicle has confirmed that it stands. */
  | { kind: "cancelled"; order: Replaced }
  /** It had ended before, by itself or by somebody else: nothing was left to cancel. */
  | { kind: "had_ended"; order: Replaced }
  | { kind: "failed"; order: Replaced; problem: Refusal };

/** What became of the request to cancel, when it was not taken. */
export function notCancelled(
  order: Replaced,
  problem: Pick<ApiProblem, "status" | keyof Refusal>,
): Replacing {
  const over = problem.code === "not_in_this_state" || problem.code === "unknown_job_order";
  return over ? { kind: "had_ended", order } : { kind: "failed", order, problem };
}
