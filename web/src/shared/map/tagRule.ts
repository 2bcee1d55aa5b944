import type { DrawnVehicle } from "./scene";

const kAllTagsUpTo = 40;

type Marks = Pick<
  DrawnVehicle,
  "selected" | "critical" | "blocked" | "stale" | "blocker" | "waiting" | "inHand" | "moving"
>;

export interface TagRule {
  /** Order in which tags get their places; smaller first. */
  rank: number;
  /** Never dropped: it takes the place that hides least. */
  must: boolean;
  /** Far out an ordinary one shows its name alone; of one in a person's hands the tag says whose. */
  brief: boolean;
}

/**
 * Which vehicles get a tag. Up to forty in view: all, the small ones too, so that no two look alike. Above that those
 * that a person has to tell apart; the others are still drawn and pressed, and named when the map shows less of the hall.
 */
export function tagRule(v: Marks, inView: number): TagRule | undefined {
  const urgent = v.selected || v.critical || v.blocked || v.stale || v.blocker;
  const few = inView <= kAllTagsUpTo;
  if (!few && !urgent && !v.waiting && !v.inHand) return undefined;
  const rank = v.selected ? 0 : urgent ? 1 : v.waiting || v.inHand ? 2 : v.moving ? 4 : 5;
  return { rank, must: urgent || few, brief: !urgent && !v.inHand };
}
