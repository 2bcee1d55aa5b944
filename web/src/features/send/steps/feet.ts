import type { NewJobOrder, Vehicle } from "@/shared/api/types";
import { feetDown } from "@/shared/live/feet";
import type { Preview } from "../preview/preview";
import type { StepAction } from "@/shared/words/actions";
import { transferAction, type Transfer } from "./transfer";
import type { ShownCheck } from "./wayChecks";

type NewStep = NewJobOrder["steps"][number];

/** What the feet do around a move: raised before it where they are down, or may be by then; lowered after it where a person wants it. */
export interface FeetPlan {
  raise: boolean;
  lower: boolean;
}

export function feetPlan(
  vehicle: Pick<Vehicle, "parking_feet"> | undefined,
  /** It ends another order first. */ behind: boolean,
  park: boolean,
): FeetPlan {
  const feet = vehicle?.parking_feet ?? [];
  return { raise: feet.length > 0 && (behind || feetDown(feet)), lower: feet.length > 0 && park };
}

/** `after` is always said, be it that nothing is done: what a person has not ticked is not done. */
export function moveActions(
  { raise, lower }: FeetPlan,
  transfer: Transfer | undefined,
  brackets: StepAction | undefined,
): Pick<NewStep, "before" | "after"> {
  return {
    ...(raise && { before: [{ type: "raiseParking" }] }),
    // What is to be set down needs brackets that are high enough; that or a take-over needs the vehicle on its wheels.
    after: [
      ...(brackets ? [brackets] : []),
      ...(transfer ? [transferAction(transfer)] : []),
      ...(lower ? [{ type: "lowerParking" }] : []),
    ],
  };
}

/** Feet that the move itself raises first hold nothing back: they are told, and not failed or waited for. */
function withFeetRaised(check: ShownCheck): ShownCheck {
  if (check.code === "parking_feet" && check.result === "fail") return { ...check, result: "note" };
  const onlyFeet = check.code === "mode" && check.params.reason === "parking_feet_down";
  return onlyFeet ? { ...check, result: "pass", params: {} } : check;
}

export function previewWithFeet(preview: Preview, { raise }: FeetPlan): Preview {
  if (!raise) return preview;
  const raised = <T extends { checks: ShownCheck[] }>(data: T): T => ({
    ...data,
    checks: data.checks.map(withFeetRaised),
  });
  if (preview.kind === "ready") return { ...preview, data: raised(preview.data) };
  if (preview.kind === "loading" && preview.last) return { ...preview, last: raised(preview.last) };
  return preview;
}
