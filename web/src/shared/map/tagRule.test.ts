import { expect, it } from "vitest";
import { tagRule } from "./tagRule";

const plain = {
  selected: false,
  critical: false,
  blocked: false,
  stale: false,
  blocker: false,
  waiting: false,
  inHand: false,
  moving: false,
};

it.each([
  ["a standing one of forty is named", {}, 40, { rank: 5, must: true, brief: true }],
  ["a standing one of a hundred is drawn without a name", {}, 100, undefined],
  ["so is a moving one", { moving: true }, 100, undefined],
  [
    "one that waits is named where there is room",
    { waiting: true },
    100,
    { rank: 2, must: false, brief: true },
  ],
  [
    "one in a person's hands as well, and whose",
    { inHand: true },
    100,
    { rank: 2, must: false, brief: false },
  ],
  ["a blocked one always", { blocked: true }, 100, { rank: 1, must: true, brief: false }],
  ["an old one always", { stale: true }, 100, { rank: 1, must: true, brief: false }],
  ["whom the selected one waits for always", { blocker: true }, 100, { rank: 1, must: true, brief: false }],
  ["the selected one first", { selected: true, blocked: true }, 100, { rank: 0, must: true, brief: false }],
])("%s", (_, marks, inView, rule) => expect(tagRule({ ...plain, ...marks }, inView)).toEqual(rule));
