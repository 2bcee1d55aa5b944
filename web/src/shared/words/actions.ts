import type { NewJobOrder, Params } from "@/shared/api/types";
import { millimetres } from "./format";
import { noNames, sentence, type Names, type Translate } from "./sentence";

export type StepAction = NonNullable<NewJobOrder["steps"][number]["after"]>[number];

const kAll = "all"; // brackets, which move in step

/** An action around a drive in words; what is not known here by its type, as an integrator may have named it. */
export function actionText(action: StepAction, t: Translate, names: Names = noNames): string {
  return sentence(`words:action.${action.type}`, shown(action.parameters ?? {}), names, t) ?? action.type;
}

function shown({ bracket, height_m, ...rest }: Params): Params {
  return {
    ...rest,
    ...(bracket !== undefined && bracket !== kAll && { bracket }),
    ...(typeof height_m === "number" && { height: inMillimetres(height_m) }),
  };
}

function inMillimetres(height_m: number): string {
  const isWhole = Math.round(height_m * 10_000) % 10 === 0;
  return millimetres(height_m, { decimals: isWhole ? 0 : 1 });
}
