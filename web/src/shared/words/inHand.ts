import type { Vehicle } from "@/shared/api/types";
import { actorText } from "./actor";
import type { Translate } from "./sentence";

/** Who drives a vehicle by hand; undefined: nobody. */
export function inHandText({ in_hand_of }: Pick<Vehicle, "in_hand_of">, t: Translate): string | undefined {
  if (in_hand_of === undefined) return undefined;
  return in_hand_of === ""
    ? t("words:in_hand.beside")
    : t("words:in_hand.by", { person: actorText(in_hand_of, t) });
}
