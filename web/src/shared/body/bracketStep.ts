import type { VehicleType } from "@/shared/api/types";
import type { StepAction } from "@/shared/words/actions";
import { kAll, readHeight } from "./lifts";

/** What a person writes of brackets that move on arrival: one of them, or all in step, and the height in mm. */
export interface BracketsDraft {
  bracket: string;
  text: string;
}
export const emptyBrackets = (): BracketsDraft => ({ bracket: kAll, text: "" });

/** Brackets of whoever may come: those that all have, as high as each of them reaches. */
export interface BracketLift {
  stroke_m: number;
  names: string[];
}

export function liftOf(types: readonly (VehicleType | undefined)[]): BracketLift | undefined {
  const lifts = types.flatMap((type) =>
    type?.bracket_lift === undefined || type.brackets.length === 0
      ? []
      : [{ stroke_m: type.bracket_lift.stroke_m, names: type.brackets.map(({ name }) => name) }],
  );
  const [first, ...others] = lifts;
  if (first === undefined) return undefined;
  return {
    stroke_m: Math.min(...lifts.map(({ stroke_m }) => stroke_m)),
    names: first.names.filter((name) => others.every(({ names }) => names.includes(name))),
  };
}

export type BracketsFault = "empty" | "bad_height" | "no_such_bracket";

/** The height that is asked for, or why it cannot be; neither: nothing is asked. */
export function bracketsWanted(
  draft: BracketsDraft | undefined,
  lift: BracketLift | undefined,
): { action?: StepAction; fault?: BracketsFault } {
  if (draft === undefined || lift === undefined) return {};
  const { bracket } = draft;
  if (bracket !== kAll && !lift.names.includes(bracket)) return { fault: "no_such_bracket" };
  const height = readHeight(draft.text, lift.stroke_m);
  if (height.kind !== "height") return { fault: height.kind };
  return { action: { type: "setBracketHeight", parameters: { bracket, height_m: height.height_m } } };
}
