import { expect, it } from "vitest";
import { inHandText } from "./inHand";
import type { Translate } from "./sentence";

const t: Translate = (key, values) => [key, ...Object.values(values ?? {})].join(" ");

it.each([
  ["nobody", {}, undefined],
  ["a person at a control", { in_hand_of: "ann" }, "words:in_hand.by ann"],
  ["somebody beside it", { in_hand_of: "" }, "words:in_hand.beside"],
  ["a program", { in_hand_of: "token:019aeb12" }, "words:in_hand.by words:program 019aeb"],
])("in the hands of %s", (_, vehicle, text) => expect(inHandText(vehicle, t)).toBe(text));
