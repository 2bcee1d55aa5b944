import { expect, it } from "vitest";
import { actionText, type StepAction } from "./actions";
import alarmsEn from "./catalogs/alarms.en.json";
import alarmsZh from "./catalogs/alarms.zh.json";
import wordsEn from "./catalogs/words.en.json";
import wordsZh from "./catalogs/words.zh.json";
import { noNames, type Translate } from "./sentence";

const from =
  (catalogs: Record<string, object>): Translate =>
  (key, values) => {
    const [catalog = "", path = ""] = key.split(":");
    const found = path
      .split(".")
      .reduce<unknown>((o, k) => (o as Record<string, unknown> | undefined)?.[k], catalogs[catalog]);
    return typeof found === "string" ? found : String(values?.["defaultValue"] ?? key);
  };
const names = { ...noNames, load: (id: string) => (id === "l1" ? "A-101" : undefined) };

it.each<[StepAction, string, string]>([
  [{ type: "lowerParking" }, "Feet down", "放下支脚"],
  [{ type: "raiseParking" }, "Feet up", "收起支脚"],
  [{ type: "pick", parameters: { load: "l1" } }, "Take over A-101", "接取 A-101"],
  [{ type: "pick", parameters: { load: "l9" } }, "Take over l9", "接取 l9"],
  [{ type: "drop" }, "Set down", "放下载荷"],
  [
    { type: "setBracketHeight", parameters: { bracket: "all", height_m: 0.21 } },
    "Brackets to 210 mm",
    "支架升降至 210 mm",
  ],
  [
    { type: "setBracketHeight", parameters: { bracket: "front left", height_m: 0.0205 } },
    "Bracket front left to 20.5 mm",
    "左前支架升降至 20.5 mm",
  ],
  [{ type: "polish", parameters: { times: 2 } }, "polish", "polish"],
])("%o is %s and %s", (action, en, zh) => {
  expect(actionText(action, from({ words: wordsEn, alarms: alarmsEn }), names)).toBe(en);
  expect(actionText(action, from({ words: wordsZh, alarms: alarmsZh }), names)).toBe(zh);
});
